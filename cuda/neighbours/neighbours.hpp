// Neighbour lists: which source particles lie within a reach of each target particle.
#pragma once

#include "backend/buffer.hpp"
#include "backend/lanes.hpp"
#include "backend/rows.hpp"
#include "fluid/math.hpp"
#include "fluid/params.hpp"
#include "neighbours/cells.hpp"
#include "neighbours/list_gate.hpp"

namespace slagflow {

// Rows of a list are stored in slices of `slice_width` targets whose k-th entries stand side by side, so that
// the threads of a warp load neighbouring words; a width of one keeps each row in one piece, as a CPU wants
// it. A row takes room for whole lanes; the entries beyond its length are valid particle numbers.
#if defined(SLAGFLOW_CUDA)
inline constexpr int slice_width = 32;
#else
inline constexpr int slice_width = 1;
#endif

HOST_DEVICE inline Offset whole_lanes(Index entries) {
  return (static_cast<Offset>(entries) + lane_count - 1) / lane_count * lane_count;
}

// Of so many entries, in a byte: 255 stands for as many or more.
HOST_DEVICE inline std::uint8_t registers(Index entries) {
  return static_cast<std::uint8_t>(smaller(whole_lanes(entries) / lane_count, Offset(255)));
}

struct ListView {
  Span<const Offset> slice;  // where each slice begins
  Span<const Index> length;  // entries of each row
  Span<const Index> entry;

  HOST_DEVICE static Offset stride() { return slice_width; }
  HOST_DEVICE Offset row(Index i) const { return slice[i / slice_width] + i % slice_width; }
};

template <class Box>
struct Search;

// What a list is made of: for each target the sources closer than `reach` [m]. With `self` targets and
// sources are the same particles, and a particle is not its own neighbour.
enum class Pairs { self, other };
struct ListedParticles {
  SourceView sources;
  Span<const Quad> targets;
  Rows count;                      // of the targets
  Span<const Index> target_start;  // first target of each cell, sorted as the sources are
  PeriodicBox box;
  Real reach;
  Pairs pairs;
};

class NeighbourList {
 public:
  NeighbourList(Context&, const char* name);

  // Fills all rows, in the order of the sources, which are in the cells that their places are in.
  // Throws Error when memory ends.
  using Pairs = slagflow::Pairs;
  void build(const SourceView& sources, Span<const Quad> targets, const PeriodicBox& box, Real reach, Pairs);

  // Fills the rows of targets in worn cells anew, of particles that have moved since build(), in the cells
  // where they were then, no farther than ListAge allows. Where the gate is shut this is idle. Without
  // waiting: where rows have outgrown their room on a GPU, record->worn tells so, and all is to be built.
  struct Worn {
    Span<const std::uint8_t> cells;  // 1: worn
    ListGate gate;
    StepRecord* record;
  };
  void renew(const ListedParticles&, const Worn&);

  // The rows as they are, from the places of now: which of the pairs between h and h + 2 skins apart are
  // listed, a bit each. All closer pairs are, and no others. Whole bytes to a row.
  struct Doubtful {
    Real from, to;  // h and h + 2 skins, with some room for rounding [m]
  };
  std::vector<std::uint8_t> remember(const ListedParticles&, const Doubtful&);
  // After build(), and with the places of then. False where the bits are not those of these particles.
  bool recall(const ListedParticles&, const Doubtful&, const std::vector<std::uint8_t>&);

  ListView view() const { return {slice_.span(), length_.span(), entry_.span()}; }
  // Entries, padding included: for how many there is room, and how many build() filled.
  Offset capacity() const { return entry_.size(); }
  Offset filled() const { return filled_; }
  // Of lists of others: cells of targets that may have a source near until the next build.
  Span<const std::uint8_t> near_sources() const { return occupied_.span(); }

 private:
  template <class Box>
  void search_and_store(const Search<Box>&);
  template <class Box>
  void store_rows(const Search<Box>&);  // a row at a time, each in one piece
  template <class Box>
  void store_slices(const Search<Box>&);
  template <class Box>
  void renew_in(const Box&, const ListedParticles&, const Worn&);
  template <class Box>
  Search<Box> search(const Box& box, const ListedParticles& p) const {
    return {p.sources,        p.targets,          box, p.reach, p.pairs == Pairs::self,
            occupied_.span(), target_cell_.span()};
  }
  void find_target_cells(const ListedParticles&);
  template <class Box>
  std::vector<std::uint8_t> remember_in(const Box&, const ListedParticles&, const Doubtful&);
  template <class Box>
  bool recall_in(const Box&, const ListedParticles&, const Doubtful&, const std::vector<std::uint8_t>&);
  template <class Box>
  Offset measure_bits(const Search<Box>&, Real from, Buffer<Offset>& start);
  void make_room();
  void mark_occupied(const CellGrid&, Span<const Index> cell_start);

  Context& context_;
  Buffer<Index> length_, target_cell_;
  Buffer<Offset> slice_length_, slice_, used_;
  Buffer<Index> entry_;
  Buffer<std::uint8_t> room_;              // of each row in one piece
  Buffer<std::uint8_t> occupied_, spare_;  // of each cell
  Offset filled_ = 0;
};

}  // namespace slagflow
