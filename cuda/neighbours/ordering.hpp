// Keeps the particles sorted by cell, and removes those that have left the domain.
#pragma once

#include <array>
#include <cstdint>

#include "backend/primitives.hpp"
#include "fluid/particles.hpp"
#include "neighbours/cells.hpp"

namespace slagflow {

inline constexpr int faces = 6;  // -x +x -y +y -z +z

// Counts of removed particles by face and by fluid.
using DepartureCounts = std::vector<std::array<std::int64_t, faces>>;

class Ordering {
 public:
  Ordering(Context&, Vec3d extent, const std::array<bool, 3>& periodic, const CellGrid&);

  // Sorts by cell, then by id, all arrays of the fluid; wraps positions on periodic axes; drops particles
  // outside of the domain and adds them to `departed` (one entry per fluid). Derived arrays (state, pressure,
  // shear rate) keep their values.
  void sort(FluidArrays&, DepartureCounts& departed);
  // Drops the particles of walls that have vanished.
  void sort(WallArrays&);

  // Finds the cells of particles that are in order already.
  void find_cells(const FluidArrays&);

  SourceView fluid_sources(const FluidArrays& f) const {
    return {grid_, fluid_cells_.start.span(), f.place.span()};
  }
  SourceView wall_sources(const WallArrays& w) const {
    return {grid_, wall_cells_.start.span(), w.place.span()};
  }

 private:
  // Sorts key_ and order_, both of `count` elements.
  void sort_keys(Index count);
  template <class T>
  void reorder(Buffer<T>& values, Buffer<T>& spare, Index count);
  Index drop(const FluidArrays&, DepartureCounts& departed);

  Context& context_;
  Vec3d extent_;
  CellGrid grid_;
  std::array<bool, 3> periodic_;
  CellRanges fluid_cells_, wall_cells_;
  Buffer<std::uint64_t> key_, spare_key_;
  Buffer<Index> order_, spare_order_, spare_index_;
  Buffer<std::uint8_t> exit_, spare_kind_;
  Buffer<double> flag_;
  Buffer<Vec3d> spare_position_;
  Buffer<Quad> spare_quad_;
  Buffer<Real> spare_real_;
};

}  // namespace slagflow
