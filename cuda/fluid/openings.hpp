// Where fluid comes in and goes out, in plain host data, and what the device knows of outlets.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "backend/span.hpp"
#include "fluid/math.hpp"

namespace slagflow {

// How fast fluid comes through an inlet, as a mean over its face: linear between rows, the first speed before
// them and the last one after; nothing before `start` and after `stop`. A function of time alone, so that
// nothing accumulates.
struct FeedRate {
  std::vector<double> time{0}, speed{0};  // [s] ascending, [m/s] >= 0
  double start = 0, stop = 1e30;          // [s]

  double at(double now) const;         // [m/s]
  double travelled(double now) const;  // [m] from the start of the clock
  double fastest() const;              // [m/s]

 private:
  double speed_at(double now) const;
  double integral(double now) const;  // of speed_at, from the first row
};

// An inlet is a wall that comes on with the fluid it feeds: columns of wall particles behind its face, each
// with a speed of its own. When a column has come on by a stride its foremost particle turns to fluid, and
// the others count as one row further back.
struct InletSetup {
  std::string name;
  std::size_t body = 0;    // index into SimulationSetup::bodies, of its wall particles
  std::uint8_t fluid = 0;  // index into SimulationSetup::fluids
  Vec3d normal;            // unit vector the fluid goes along
  double stride = 0;       // [m] between the particles of a column
  FeedRate rate;
  std::vector<Vec3d> origin;  // [m] where a column goes through the face
  std::vector<double> share;  // of each column: its speed over the mean
  double temperature = 0;     // [K], where heat is on
};

// Takes away the fluid that comes into a box.
struct OutletSetup {
  std::string name;
  Vec3d lower, upper;  // [m]
};

// The same relative to the domain's lower corner.
struct OutletBox {
  Vec3d lower, upper;  // [m]
  HOST_DEVICE bool holds(Vec3d x) const {
    return x.x >= lower.x && x.x <= upper.x && x.y >= lower.y && x.y <= upper.y && x.z >= lower.z &&
           x.z <= upper.z;
  }
};

// The first outlet that a place is in, or -1.
HOST_DEVICE inline int outlet_at(Span<const OutletBox> outlets, Vec3d x) {
  for (Offset k = 0; k < outlets.size; ++k)
    if (outlets[k].holds(x)) return static_cast<int>(k);
  return -1;
}

}  // namespace slagflow
