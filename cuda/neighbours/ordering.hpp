// Keeps the particles sorted by cell, and removes those that have left the domain.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "backend/primitives.hpp"
#include "fluid/migration.hpp"
#include "fluid/openings.hpp"
#include "fluid/particles.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

inline constexpr int faces = 6;  // -x +x -y +y -z +z

// Counts of removed particles by face and by fluid.
using DepartureCounts = std::vector<std::array<std::int64_t, faces>>;

class Ordering {
 public:
  Ordering(Context&, Vec3d extent, const std::array<bool, 3>& periodic, const CellGrid&);

  // Outlets, by default none, for as many fluids.
  void set_outlets(const std::vector<OutletBox>& boxes, std::size_t fluids) {
    outlets_.upload(boxes);
    removed.assign(boxes.size() * fluids, 0);
  }
  Span<const OutletBox> outlets() const { return outlets_.span(); }

  // Sorts by cell, then by id, all arrays of the fluid; wraps positions on periodic axes; drops particles
  // outside of the domain and adds them to `departed` (one entry per fluid), and those in outlets, adding
  // them to `removed`. Derived arrays (state, pressure, shear rate) keep their values.
  void sort(FluidArrays&, DepartureCounts& departed);
  // Drops the particles of walls that have vanished.
  void sort(WallArrays&);

  std::vector<std::int64_t> removed;  // by outlet, then by fluid

  // Finds the cells of particles that are in order already.
  void find_cells(FluidArrays&);

  // With several ranks: deals all particles of the start, with these places in the domain, out by their
  // number in each plane; sort() then keeps those of its slab.
  void deal_out(const std::vector<Vec3d>& fluid, const std::vector<Vec3d>& walls);
  bool owns(Vec3d place) const;
  // The same of fluid that is in order already, by its places then: how much of it is this rank's, and at the
  // ends of its slab.
  struct Dealt {
    Index own = 0;
    Borders borders;
  };
  Dealt deal_out(const std::vector<Quad>& places);
  // Before the sorts of a build: moves the cuts between the ranks to where each has as many particles.
  // Whether any has moved.
  bool balance();
  const Slabs& slabs() const { return slabs_; }

  SourceView fluid_sources(const FluidArrays& f) const {
    return {grid_, fluid_cells_.start.span(), f.place.span()};
  }
  SourceView wall_sources(const WallArrays& w) const {
    return {grid_, wall_cells_.start.span(), w.place.span()};
  }

 private:
  // Sorts key_ and order_, both of `count` elements.
  void sort_keys(Index count);
  // All arrays as order_ says, of `count` particles.
  void reorder(const ParticleArrays&, Index count);
  Index drop(const FluidArrays&, DepartureCounts& departed);
  void put_in_planes(FluidArrays&);
  // Of `count` sorted rows those of other ranks go there, at the end; or, at the start, are there already.
  // Finds the cells of those that are left.
  template <class Arrays>
  void deal_out(Arrays&, CellRanges&, Index count, bool& dealt);
  template <class Arrays>
  void find_cells(Arrays&, CellRanges&);
  std::vector<Index> leaving_to(Index first, Index count);
  void take_cuts();

  Context& context_;
  Vec3d extent_;
  CellGrid grid_;
  Slabs slabs_;
  std::array<bool, 3> periodic_;
  CellRanges fluid_cells_, wall_cells_;
  Buffer<std::uint64_t> key_, spare_key_;
  Buffer<Index> order_, spare_order_;
  Buffer<OutletBox> outlets_;
  Buffer<int> cuts_;                                // empty: there is one rank
  bool fluid_dealt_ = false, walls_dealt_ = false;  // else each rank has all of them
  Buffer<std::uint8_t> exit_;
  Buffer<double> flag_;
  // On a CPU: where reordered values go; it takes the place of the array that they come from.
  std::tuple<Buffer<Vec3d>, Buffer<Quad>, Buffer<double>, Buffer<float>, Buffer<Index>, Buffer<std::uint8_t>>
      spare_;
};

}  // namespace slagflow
