#include "host/geometry/measure_setup.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/inlet_face.hpp"
#include "host/geometry/site_areas.hpp"

namespace slagflow {
namespace {

// Four points a spacing.
int points_along(const Case& c, double length) {
  return static_cast<int>(std::clamp(std::ceil(4 * length / c.spacing) + 1, 2.0, 20000.0));
}

LineSetup level_line(const Case& c, const MeasureSpec& measure) {
  return {measure.start, measure.end, points_along(c, norm(measure.end - measure.start))};
}

RectangleSetup rectangle(const Case& c, const MeasureSpec& measure) {
  constexpr double all = 1e9;  // [m], of y with two dimensions
  const FaceFrame frame = frame_of(c, measure.center, measure.normal, measure.up);
  return {frame.center,        frame.normal, frame.u, frame.v, c.dimensions == 2 ? all : 0.5 * measure.width,
          0.5 * measure.height};
}

// Upwards from each point of each line, as far as the domain goes.
SurfaceSetup surface(const Case& c, const MeasureSpec& measure) {
  const Direction fall = down(c);
  SurfaceSetup setup;
  for (int row = 0; row < measure.rows; ++row)
    for (int k = 0; k < measure.points; ++k) {
      const double share = k / (measure.points - 1.0),
                   aside = measure.rows > 1 ? row / (measure.rows - 1.0) : 0;
      const Vec3d start = measure.start + share * (measure.end - measure.start) + aside * measure.across;
      Vec3d end = start;
      end[fall.axis] = fall.sign < 0 ? c.domain.upper[fall.axis] : c.domain.lower[fall.axis];
      const double least = 0.25 * c.spacing;  // where a line runs along the top
      if (std::abs(end[fall.axis] - start[fall.axis]) < least)
        end[fall.axis] = start[fall.axis] - fall.sign * least;
      setup.columns.push_back({start, end, points_along(c, norm(end - start))});
    }
  return setup;
}

void add_measure(const Case& c, const MeasureSpec& measure, SimulationSetup& setup) {
  const FrontSetup plane{measure.direction.axis, measure.direction.sign, measure.position};
  switch (measure.type) {
    case MeasureType::front:
      return setup.fronts.push_back(plane);
    case MeasureType::jet:
      return setup.fronts.push_back({down(c).axis, down(c).sign, measure.bottom});
    case MeasureType::flow_rate:
      return setup.planes.push_back(plane);
    case MeasureType::volume:
      return setup.boxes.push_back({measure.min, measure.max});
    case MeasureType::profile:
      return setup.lines.push_back({measure.start, measure.end, measure.points});
    case MeasureType::level:
      return setup.levels.push_back(level_line(c, measure));
    case MeasureType::flux:
      return setup.rectangles.push_back(rectangle(c, measure));
    case MeasureType::surface:
      return setup.surfaces.push_back(surface(c, measure));
    case MeasureType::contact:
      return setup.contacts.push_back(static_cast<std::size_t>(measure.wall));
    case MeasureType::residence:
      return setup.residences.push_back(static_cast<std::size_t>(measure.outlet));
    case MeasureType::solid:
      return setup.solids.push_back({{measure.min, measure.max}, measure.solid_fraction});
    case MeasureType::mixing:  // of a snapshot
    case MeasureType::heat:
      return;
    case MeasureType::force:
      setup.measure_walls = true;
  }
}

}  // namespace

void add_measures(const Case& c, SimulationSetup& setup) {
  for (const MeasureSpec& measure : c.measures) add_measure(c, measure, setup);
  std::vector<std::size_t> bodies = setup.contacts;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b)
    if (setup.bodies[b].thermal.kind != WallHeat::adiabatic) bodies.push_back(b);
  if (!bodies.empty()) setup.site_area = site_areas(c, setup, bodies);
}

}  // namespace slagflow
