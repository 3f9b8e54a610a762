// What is measured of the fluid during a run besides its totals: the flow through planes, the volume in
// boxes, profiles along lines.
#pragma once

#include <vector>

#include "fluid/diagnostic_scratch.hpp"
#include "fluid/setup.hpp"
#include "neighbours/ordering.hpp"
#include "observation/totals.hpp"

namespace slagflow {

// Counts the particles that pass planes, less those that come back. Only the net number counts, so it is
// enough to compare the sides on which a particle stands at one rebuild of the neighbour lists and at the
// next: a step costs nothing. On a periodic axis the plane repeats with the period. Whole numbers, so that
// nothing is lost to rounding:
//   passed + behind + lost_behind = start_behind
class PlaneCounters {
 public:
  // What each plane has seen up to the last rebuild; kept in checkpoints.
  struct Record {
    std::int64_t start_behind = 0, passed = 0, lost_behind = 0;
  };

  // Positions on the device are relative to setup.domain.lower.
  explicit PlaneCounters(const SimulationSetup&);

  // Counts what stands behind each plane at the start.
  void begin(Context&, const FluidArrays&, DiagnosticScratch&);
  // Before particles are sorted and dropped, by outlets too. `before`: their places at the last rebuild.
  void advance(Context&, const FluidArrays&, Span<const Quad> before, DiagnosticScratch&,
               Span<const OutletBox> outlets = {});
  // Counts what has come in since, at places relative to the domain, as if it had been there from the start.
  void add(const std::vector<Vec3d>& places);
  // Now, between two rebuilds.
  void states(const FluidArrays&, Span<const Quad> before, GatheredSums&, std::vector<PlaneState>&) const;

  template <class Visitor>
  void save(Visitor& v) {
    v.as_many("planes", records);
  }

  std::vector<Record> records;

 private:
  std::vector<FrontSetup> planes_;
  Vec3d extent_;
  std::array<bool, 3> periodic_;
  std::vector<Real> place_;  // of each plane, relative to the domain
};

// Fluid particles in a box, its lower faces included.
void count_in_box(GatheredSums&, const FluidArrays&, const BoxSetup&, Vec3d origin, std::int64_t& count);
// Of those in a box the ones with as many solids; none where heat is off.
void count_solid(GatheredSums&, const FluidArrays&, const SolidSetup&, Vec3d origin, std::int64_t& count);

// What is needed to find the particles around a point: `drift` is how far they may have moved since they were
// sorted into the cells [m].
struct ProfileSource {
  const FluidArrays& fluid;
  SourceView cells;
  PeriodicBox box;
  Smoothing smoothing;
  double drift;  // [m]
};

struct AroundPoint;
AroundPoint around(const ProfileSource&);

// The fluid at evenly spaced points of a line, both ends included: a linear function fitted to the particles
// within the support, weighted by V_j W, so that linear fields come out exactly, next to walls and free
// surfaces too. Without value (not-a-number) where less than a quarter of the support is filled.
std::vector<ProfilePoint> measure_profile(Context&, const ProfileSource&, const LineSetup&, Vec3d origin);

// What a profile tells of the surface.
LevelState level_of(const std::vector<ProfilePoint>&);

// With several ranks: of what was found at these points that of the rank which has the point's plane, on all.
template <class T>
void join_at_owners(const ProfileSource& source, const std::vector<Quad>& points, std::vector<T>& found) {
  if (!source.fluid.count.halo) return;
  const CellGrid& grid = source.cells.grid;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int plane = grid.local_plane(grid.plane_at(xyz(points[k])));
    if (plane < 0 || plane >= grid.slab.own) found[k] = {};
  }
  ranks().join(found.data(), found.size() * sizeof(T));
}

}  // namespace slagflow
