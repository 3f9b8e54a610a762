// The rows of a list as they are, without the list: some bits, and the places of its particles.
#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "backend/reduce.hpp"
#include "neighbours/group_search.hpp"

namespace slagflow {

namespace {

// Calls visit(j, near) for the sources that row i may hold, in the order of its entries; near: it does hold
// j.
template <class Box, class Visit>
HOST_DEVICE void for_candidates(const Search<Box>& search, Index i, Real from, Visit visit) {
  const Vec3 here = xyz(search.targets[i]);
  search(i, [&](Index first, unsigned lanes) {
    for (int k = 0; k < lane_count; ++k) {
      if (!(lanes >> k & 1)) continue;
      const Vec3 d = search.box.separation(here, xyz(search.sources.place[first + k]));
      visit(first + k, dot(d, d) < square(from));
    }
  });
}

// Bytes for the bits of a row.
template <class Box>
struct MeasureBits {
  Search<Box> search;
  Real from;
  Span<Offset> bytes;
  HOST_DEVICE void operator()(Index i) const {
    Offset doubtful = 0;
    for_candidates(search, i, from, [&](Index, bool near) { doubtful += near ? 0 : 1; });
    bytes[i] = (doubtful + 7) / 8;
  }
};

template <class Box>
struct WriteBits {
  Search<Box> search;
  Real from;
  ListView list;
  Span<const Offset> start;
  Span<std::uint8_t> bits;
  HOST_DEVICE void operator()(Index i) const {
    for (Offset at = start[i]; at < start[i + 1]; ++at) bits[at] = 0;
    Offset bit = 0;
    Index entry = 0;
    const ListRow row = list.entries(i);
    for_candidates(search, i, from, [&](Index j, bool near) {
      const bool listed = entry < list.length[i] && row.one(entry) == j;
      if (listed) ++entry;
      if (near) return;
      if (listed) bits[start[i] + bit / 8] |= static_cast<std::uint8_t>(1 << bit % 8);
      ++bit;
    });
  }
};

// Calls visit(j) for the entries of row i.
template <class Box, class Visit>
HOST_DEVICE void for_remembered(const Search<Box>& search, Index i, Real from, const std::uint8_t* bits,
                                Visit visit) {
  Offset bit = 0;
  for_candidates(search, i, from, [&](Index j, bool near) {
    const bool listed = near || (bits[bit / 8] >> bit % 8 & 1);
    if (!near) ++bit;
    if (listed) visit(j);
  });
}

template <class Box>
struct RecallLength {
  Search<Box> search;
  Real from;
  Span<const Offset> start;
  Span<const std::uint8_t> bits;
  Span<Index> length;
  Span<Offset> entries;     // with the row in one piece
  Span<std::uint8_t> room;  // the same in registers
  HOST_DEVICE void operator()(Index i) const {
    Index n = 0;
    for_remembered(search, i, from, bits.data + start[i], [&](Index) { ++n; });
    length[i] = n;
    entries[i] = whole_lanes(n);
    room[i] = registers(n);
  }
};

// What does not fit into the room of a slice is left out. How many entries the codes do not do for.
template <class Box>
struct RecallRow {
  static constexpr int terms = 1;
  Search<Box> search;
  Real from;
  Span<const Offset> start;
  Span<const std::uint8_t> bits;
  Span<const Offset> slice;
  Span<Index> length;
  CodeStore store;
  HOST_DEVICE Terms<1> operator()(Index i) const {
    const Index s = i / slice_width;
    const auto room = static_cast<Index>((slice[s + 1] - slice[s]) / slice_width);
    RowFiller row(store, slice[s] + i % slice_width, i);
    Index k = 0, misfits = 0;
    for_remembered(search, i, from, bits.data + start[i], [&](Index j) {
      if (k < room && !row.put(j)) ++misfits;
      ++k;
    });
    row.finish();
    length[i] = smaller(k, room);
    return {{static_cast<double>(misfits)}};
  }
};

struct CellsOfTargets {
  Span<const Index> start;
  Span<Index> cell;
  HOST_DEVICE void operator()(Index c) const {
    for (Index i = start[c]; i < start[c + 1]; ++i) cell[i] = c;
  }
};

}  // namespace

void NeighbourList::find_target_cells(const ListedParticles& p) {
  target_cell_.resize(p.targets.size);
  launch(context_, "cells of targets", p.sources.grid.own_cells(),
         CellsOfTargets{p.target_start, target_cell_.span()});
}

// Where the bytes of each row begin, and how many there are.
template <class Box>
Offset NeighbourList::measure_bits(const Search<Box>& search, Real from, Buffer<Offset>& start) {
  const auto n = static_cast<Index>(search.targets.size);
  Buffer<Offset> bytes(context_, "bits of lists", n);
  start.resize(n + 1);
  launch(context_, "bits of lists", n, MeasureBits<Box>{search, from, bytes.span()});
  exclusive_scan(context_, bytes.span(), start.span());
  Offset all = 0;
  context_.copy_to_host(&all, start.span().data + n, sizeof all);
  return all;
}

template <class Box>
std::vector<std::uint8_t> NeighbourList::remember_in(const Box& box, const ListedParticles& p,
                                                     const Doubtful& doubtful) {
  Search<Box> near = search(box, p);
  near.reach = doubtful.to;
  Buffer<Offset> start(context_, "bits of lists");
  Buffer<std::uint8_t> bits(context_, "bits of lists", measure_bits(near, doubtful.from, start));
  launch(context_, "bits of lists", static_cast<Index>(p.targets.size),
         WriteBits<Box>{near, doubtful.from, view(), start.span(), bits.span()});
  std::vector<std::uint8_t> host;
  bits.download(host);
  return host;
}

std::vector<std::uint8_t> NeighbourList::remember(const ListedParticles& p, const Doubtful& doubtful) {
  find_target_cells(p);
  return p.box.any() ? remember_in(p.box, p, doubtful) : remember_in(OpenBox{}, p, doubtful);
}

template <class Box>
bool NeighbourList::recall_in(const Box& box, const ListedParticles& p, const Doubtful& doubtful,
                              const std::vector<std::uint8_t>& saved) {
  const auto n = static_cast<Index>(p.targets.size);
  Search<Box> near = search(box, p);
  near.reach = doubtful.to;
  Buffer<Offset> start(context_, "bits of lists");
  const PartOfRows part(measure_bits(near, doubtful.from, start));
  if (part.all != static_cast<Offset>(saved.size())) return false;
  Buffer<std::uint8_t> bits(context_, "bits of lists");
  bits.upload({saved.begin() + part.first, saved.begin() + part.first + part.own});
  if constexpr (slice_width == 1) {
    Buffer<Offset> entries(context_, "entries of rows", n);
    launch(context_, "lengths of rows", n,
           RecallLength<Box>{near, doubtful.from, start.span(), bits.span(), length_.span(), entries.span(),
                             room_.span()});
    slice_.resize(n + 1);
    exclusive_scan(context_, entries.span(), slice_.span());
    used_.upload({slice_.span()[n], 0});
    make_room();
  }
  launch_reduction<AddUp>(context_, "rows as they were", n,
                          RecallRow<Box>{near, doubtful.from, start.span(), bits.span(), slice_.span(),
                                         length_.span(), code_store()},
                          KeepMisfits{used_.span().data + 1});
  Offset misfits = 0;
  context_.copy_to_host(&misfits, used_.span().data + 1, sizeof misfits);
  return ranks().added(misfits) == 0;
}

bool NeighbourList::recall(const ListedParticles& p, const Doubtful& doubtful,
                           const std::vector<std::uint8_t>& saved) {
  find_target_cells(p);
  return p.box.any() ? recall_in(p.box, p, doubtful, saved) : recall_in(OpenBox{}, p, doubtful, saved);
}

}  // namespace slagflow
