// Neighbour lists: which source particles lie within a reach of each target particle.
#pragma once

#include "backend/buffer.hpp"
#include "backend/rows.hpp"
#include "fluid/math.hpp"
#include "fluid/params.hpp"
#include "neighbours/cells.hpp"
#include "neighbours/list_gate.hpp"
#include "neighbours/row_codes.hpp"

namespace slagflow {

// Of so many entries, in a byte: 255 stands for as many or more.
HOST_DEVICE inline std::uint8_t registers(Index entries) {
  return static_cast<std::uint8_t>(smaller(whole_lanes(entries) / lane_count, Offset(255)));
}

// Where the rows of a list are.
struct RowLayout {
  Span<const Offset> slice;  // where each slice begins
  Span<const Index> length;  // entries of each row

  HOST_DEVICE static Offset stride() { return slice_width; }
  HOST_DEVICE Offset row(Index i) const { return slice[i / slice_width] + i % slice_width; }
};

struct ListView : RowLayout {
  Span<const Code> code;
  Span<const Index> base, plain;  // on a GPU: see row_codes.hpp

  HOST_DEVICE ListRow entries(Index i) const {
#if defined(SLAGFLOW_CUDA)
    return {row(i), code.data, base.data + bases_of(i), plain.data};
#else
    return {row(i), code.data};
#endif
  }
};

template <class Box>
struct Search;
struct RowStore;

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

  ListView view() const { return {{slice_.span(), length_.span()}, codes(), base_.span(), plain_.span()}; }
  // Entries, padding included: for how many there is room, and how many build() filled.
  Offset capacity() const { return all_plain_ ? plain_.size() : code_.size(); }
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
  // On a CPU: for all that has been used; false when there was.
  bool make_room();
  void resize_entries(Offset entries, Offset margin_percent);
  // On a GPU: entries of 32 bits from now on.
  void keep_plain();
  Span<const Code> codes() const { return all_plain_ ? Span<const Code>() : code_.span(); }
  CodeStore code_store();
  RowStore row_store();
  void mark_occupied(const CellGrid&, Span<const Index> cell_start);

  Context& context_;
  Buffer<Index> length_, target_cell_;
  Buffer<Offset> slice_length_, slice_;
  Buffer<Offset> used_;  // entries, and for how many the codes did not do
  Buffer<Code> code_;
  Buffer<Index> base_, plain_;
  bool all_plain_ = false;
  Buffer<std::uint8_t> room_;              // of each row in one piece
  Buffer<std::uint8_t> occupied_, spare_;  // of each cell
  Offset filled_ = 0;
};

}  // namespace slagflow
