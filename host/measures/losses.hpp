// What a run loses: fluid that leaves through faces of the domain, and fluid inside walls.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/wall_depth.hpp"
#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

// Fluid particles deeper than half a spacing in walls.
struct InWalls {
  std::int64_t most = 0;  // at any look
  std::int64_t now = 0;   // at the last look
  double deepest = 0;     // [spacings], at any look
};

class Losses {
 public:
  // Of a case that outlives it. Throws InputError when an STL file cannot be read.
  explicit Losses(const Case& c);
  explicit Losses(Case&&) = delete;

  // Looks at the particles that wall particles see below their faces; those too deep in walls to see any are
  // found at the end only.
  void look(Simulation& simulation);
  // Looks at all particles.
  void look_at_all(const Simulation& simulation);
  // At fluid particles at these places [m], at a time [s].
  void look_at(const std::vector<Vec3d>& places, double time);

  const InWalls& in_walls() const { return in_walls_; }
  void restore(std::int64_t most, double deepest) { in_walls_ = {most, 0, deepest}; }

  // For people: what has left and through which faces, what is in walls; and what no one asked for.
  std::vector<std::string> lines(const Totals& totals, std::int64_t start) const;
  std::vector<std::string> warnings(const Totals& totals, std::int64_t start) const;
  void add_to(Json& summary, const Totals& totals) const;

 private:
  const Case& c_;
  WallDepth depth_;
  InWalls in_walls_;
};

// The exits of a case as text, "-z, +x"; "none" without.
std::string exits_of(const Case& c);

}  // namespace slagflow
