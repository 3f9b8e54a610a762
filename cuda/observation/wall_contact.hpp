// Where fluid touches walls, and how hard it presses on them.
#pragma once

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "neighbours/pairs.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// Looks at the points of the surface above those wall particles that have a share of its area. Fluid touches
// the wall where it fills a quarter of the support around the point, half of what fluid against a wall does:
// it ends at its edge. The pressure there is that of the fluid around it, each particle's carried to the
// point along the gravity that the wall feels.
class WallContact {
 public:
  explicit WallContact(Context&);

  // Area and body of each wall particle, by id; nothing where no contact is measured.
  void start(const SimulationSetup&);

  // `list`: for each wall particle, the fluid particles in reach. One for each of the bodies.
  void states(const PairContext&, const ListView& list, GatheredSums&, std::vector<ContactState>&);

  // Of a wall particle: its area if there is fluid, else 0, and the pressure.
  struct Site {
    double wetted = 0, pressure = 0;
  };

 private:
  void gather(const PairContext&, std::uint8_t body, GatheredSums&, ContactState&);

  Context& context_;
  std::vector<std::size_t> bodies_;
  Vec3d origin_;
  Buffer<double> area_;
  Buffer<std::uint8_t> body_;
  Buffer<Site> site_;
};

}  // namespace slagflow
