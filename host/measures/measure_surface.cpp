#include "host/measures/measure_surface.hpp"

#include <cmath>

#include "host/measures/measure_text.hpp"

namespace slagflow {
namespace {

// Of the axis that the columns go along.
int axis_of(const LineSetup& column) {
  const Vec3d way = column.end - column.start;
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(way[k]) > std::abs(way[axis])) axis = k;
  return axis;
}

}  // namespace

double surface_of(const LineSetup& column, const LevelState& level) {
  const int axis = axis_of(column);
  return column.start[axis] + (column.end[axis] > column.start[axis] ? level.surface : -level.surface);
}

SurfaceMeasure::SurfaceMeasure(const MeasureSpec& spec, const SimulationSetup& setup, std::size_t index)
    : Measure(spec.name), index_(index), surface_(setup.surfaces.at(index)) {}

std::vector<std::string> SurfaceMeasure::columns() const {
  return {"highest_m", "mean_thickness_m", "covered_share"};
}

std::vector<double> SurfaceMeasure::update(const MeasureMoment& moment) {
  const std::vector<LevelState>& levels = moment.totals.surfaces.at(index_);
  covered_ = mean_thickness_ = 0, highest_ = unknown;
  double most = unknown;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    mean_thickness_ += levels[k].thickness / static_cast<double>(levels.size());
    if (!std::isfinite(levels[k].surface)) continue;
    covered_ += 1 / static_cast<double>(levels.size());
    const LineSetup& column = surface_.columns[k];
    const int axis = axis_of(column);
    const double up = column.end[axis] > column.start[axis] ? 1 : -1, here = surface_of(column, levels[k]);
    if (!(up * here <= most)) most = up * here, highest_ = here;
    if (!(up * here <= up * highest_so_far_)) highest_so_far_ = here, time_of_highest_ = moment.time;
  }
  return {highest_, mean_thickness_, covered_};
}

std::vector<double> SurfaceMeasure::state() const {
  return {covered_, mean_thickness_, highest_, highest_so_far_, time_of_highest_};
}

void SurfaceMeasure::restore(const double* s) {
  covered_ = s[0], mean_thickness_ = s[1], highest_ = s[2], highest_so_far_ = s[3], time_of_highest_ = s[4];
}

Json SurfaceMeasure::summary() const {
  Json result = Json::object();
  result.set("type", type()).set("columns", static_cast<std::int64_t>(surface_.columns.size()));
  result.set("file", surface_file(name())).set("highest", highest_).set("mean_thickness", mean_thickness_);
  result.set("covered_share", covered_).set("highest_so_far", highest_so_far_);
  return result.set("time_of_highest", time_of_highest_);
}

std::string SurfaceMeasure::line() const {
  if (!std::isfinite(highest_so_far_)) return "no fluid came to its columns";
  return format("%.4g m of fluid in the mean", mean_thickness_) +
         format(", on %.3g %% of its columns; ", 100 * covered_) + format("highest %.4g m", highest_so_far_) +
         format(" at %.4g s, in ", time_of_highest_) + surface_file(name());
}

std::string surface_file(const std::string& name) { return "surface_" + name + ".csv"; }

std::vector<std::string> surface_columns() {
  return {"time_s", "x_m", "y_m", "z_m", "surface_m", "height_m", "thickness_m"};
}

std::vector<std::vector<double>> surface_lines(double time, const SurfaceSetup& surface,
                                               const std::vector<LevelState>& levels) {
  std::vector<std::vector<double>> lines;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Vec3d& foot = surface.columns[k].start;
    lines.push_back({time, foot.x, foot.y, foot.z, surface_of(surface.columns[k], levels[k]),
                     levels[k].surface, levels[k].thickness});
  }
  return lines;
}

}  // namespace slagflow
