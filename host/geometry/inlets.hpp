// The columns of particles that inlets feed through their faces.
#pragma once

#include <string>
#include <vector>

#include "fluid/setup.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {

// What an inlet's face is made of.
struct InletColumns {
  Vec3d normal;               // unit vector, the way the fluid goes
  std::vector<Vec3d> origin;  // [m] where columns go through the face
  std::vector<double> share;  // of each: its speed over their mean
  // The side of the bundle that is next to each, where fluid may come to it: behind the face the columns are
  // a body in it. Depth 0: none.
  struct Side {
    Vec3d normal;
    double depth = 0;  // [m]
  };
  std::vector<Side> side;
  double area = 0;          // [m^2] that they fill, with two dimensions a height [m]
  double stride = 0;        // [m] between the particles of a column: a particle's volume over its area
  double across = 0;        // [m] the shorter way over the face
  std::size_t blocked = 0;  // columns that a wall stops at the face
};

// Places columns over the face a spacing apart: along an axis on the lattice, on a rectangle evenly between
// its edges. What a wall at rest covers in front of the face gets none. Throws InputError naming the key.
InletColumns inlet_columns(const Case&, std::size_t inlet, const Lattice&, const WallSolids&);

// "volume_flow = 1e-3 m^3/s through 0.002 m^2 is 0.5 m/s" of the key that is given, at its fastest.
std::string feed_text(const Case&, const InletSpec&, double area);
// The key: velocity, volume_flow or mass_flow.
const char* feed_key(const InletSpec&);

// [m/s] over time: the flow over the area.
FeedRate feed_rate(const Case&, const InletSpec&, double area);

// The space behind the faces that belongs to inlets: no wall and no fluid of a region is there.
class InletSpace {
 public:
  InletSpace(const Case&, std::vector<InletColumns> inlets);
  // Fluid and walls make room for the columns; of walls what leaves no gap beside them stays.
  bool holds_fluid(Vec3d p) const { return holds(p, 0.6); }
  bool holds_wall(Vec3d p) const { return holds(p, 0.3); }
  const std::vector<InletColumns>& inlets() const { return inlets_; }

 private:
  struct Box {
    Vec3d lower, upper;
    bool holds(Vec3d p) const;
  };
  bool holds(Vec3d p, double around) const;  // [spacings] of a column
  bool holds(const InletColumns&, Vec3d p, double around) const;

  double spacing_, layers_;  // layers of a wall
  std::vector<InletColumns> inlets_;
  std::vector<Box> boxes_;  // around each
};

// Adds inlets and outlets to a setup whose walls and bodies are complete.
void add_openings(const Case&, const std::vector<InletColumns>&, SimulationSetup&);

// What a setup's inlets bring by a time.
std::int64_t fed_particles(const SimulationSetup&, double time);

// Throws InputError where two inlets feed at one place at one time.
void require_apart(const Case&, const std::vector<InletColumns>&);

// Fluid: where it is at the start.
void warn_of_openings(const Case&, const std::vector<InletColumns>&, const std::vector<Vec3d>& fluid,
                      std::vector<std::string>& warnings);

}  // namespace slagflow
