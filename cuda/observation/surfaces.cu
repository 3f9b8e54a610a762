#include <limits>

#include "backend/launch.hpp"
#include "observation/around_point.hpp"
#include "observation/surfaces.hpp"

namespace slagflow {

struct SurfaceColumn {
  Vec3d start, step;  // [m] from the domain's lower corner
  double length = 0;  // [m] of a step
  int points = 0;
};

struct SearchColumn {
  static constexpr Index grain = 4;  // columns that a thread takes at a time
  AroundPoint around;
  Span<const Quad> state;
  Span<const SurfaceColumn> column;
  Span<LevelState> result;

  HOST_DEVICE void operator()(Index i) const {
    const SurfaceColumn c = column[i];
    LevelSearch search;
    for (int k = 0; k < c.points; ++k) {
      double fill = 0;
      around.for_particles(to_real(c.start + k * c.step), [&](Index j, Vec3, Real r2) {
        fill += static_cast<double>(state[j].z * around.W.value(r2));
      });
      search.add(k * c.length, fill);
    }
    result[i] = {search.surface, search.thickness};
  }
};

struct FillAtPoint {
  AroundPoint around;
  Span<const Quad> state, point;
  Span<double> fill;
  HOST_DEVICE void operator()(Index i) const {
    double sum = 0;
    around.for_particles(xyz(point[i]), [&](Index j, Vec3, Real r2) {
      sum += static_cast<double>(state[j].z * around.W.value(r2));
    });
    fill[i] = sum;
  }
};

// With several ranks: each tells of the points in its planes.
std::vector<LevelState> search_together(Context& c, const ProfileSource& source,
                                        const std::vector<SurfaceColumn>& columns) {
  std::vector<Quad> points;
  for (const SurfaceColumn& column : columns)
    for (int k = 0; k < column.points; ++k)
      points.push_back(quad(to_real(column.start + k * column.step), 0));
  Buffer<Quad> point(c, "points of a surface");
  Buffer<double> fill(c, "fills of a surface", static_cast<Offset>(points.size()));
  point.upload(points);
  launch(c, "surface", static_cast<Index>(points.size()),
         FillAtPoint{around(source), source.fluid.state.span(), point.span(), fill.span()});
  std::vector<double> fills;
  fill.download(fills);
  join_at_owners(source, points, fills);
  std::vector<LevelState> levels;
  std::size_t at = 0;
  for (const SurfaceColumn& column : columns) {
    LevelSearch search;
    for (int k = 0; k < column.points; ++k) search.add(k * column.length, fills[at++]);
    levels.push_back({search.surface, search.thickness});
  }
  return levels;
}

std::vector<LevelState> search_alone(Context& c, const ProfileSource& source,
                                     const std::vector<SurfaceColumn>& columns) {
  Buffer<SurfaceColumn> column(c, "columns of a surface");
  Buffer<LevelState> result(c, "levels of a surface", static_cast<Offset>(columns.size()));
  column.upload(columns);
  launch(c, "surface", static_cast<Index>(columns.size()),
         SearchColumn{around(source), source.fluid.state.span(), column.span(), result.span()});
  std::vector<LevelState> levels;
  result.download(levels);
  return levels;
}

std::vector<LevelState> measure_surface(Context& c, const ProfileSource& source, const SurfaceSetup& surface,
                                        Vec3d origin) {
  std::vector<SurfaceColumn> columns;
  for (const LineSetup& line : surface.columns) {
    const Vec3d step = line.at(1) - line.start;
    columns.push_back({line.start - origin, step, norm(step), line.points});
  }
  std::vector<LevelState> levels =
      source.fluid.count.halo ? search_together(c, source, columns) : search_alone(c, source, columns);
  for (LevelState& level : levels)
    if (level.surface < 0) level.surface = std::numeric_limits<double>::quiet_NaN();
  return levels;
}

}  // namespace slagflow
