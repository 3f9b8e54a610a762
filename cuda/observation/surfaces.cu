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

std::vector<LevelState> measure_surface(Context& c, const ProfileSource& source, const SurfaceSetup& surface,
                                        Vec3d origin) {
  std::vector<SurfaceColumn> columns;
  for (const LineSetup& line : surface.columns) {
    const Vec3d step = line.at(1) - line.start;
    columns.push_back({line.start - origin, step, norm(step), line.points});
  }
  Buffer<SurfaceColumn> column(c, "columns of a surface");
  Buffer<LevelState> result(c, "levels of a surface");
  column.upload(columns);
  result.resize(columns.size());
  launch(c, "surface", static_cast<Index>(columns.size()),
         SearchColumn{around(source), source.fluid.state.span(), column.span(), result.span()});
  std::vector<LevelState> levels;
  result.download(levels);
  for (LevelState& level : levels)
    if (level.surface < 0) level.surface = std::numeric_limits<double>::quiet_NaN();
  return levels;
}

}  // namespace slagflow
