// The search for neighbours as a CPU does it: particles that follow each other in one cell look at the same
// surroundings, so these are copied once, next to each other, and then compared in vector lanes. (On a GPU a
// thread searches for one particle: search.hpp.)
#pragma once

#include <vector>

#include "backend/reduce.hpp"
#include "backend/reserve.hpp"
#include "neighbours/neighbours.hpp"
#include "neighbours/search.hpp"

namespace slagflow {

// Sources that may be within reach of a group of targets, in the order of the sources.
struct Candidates {
  static constexpr Index most = 2048;
  Index count = 0;
  Index own = 0;  // target i that is a source stands at own + i
  Real x[most + lane_count], y[most + lane_count], z[most + lane_count];
  Index number[most + lane_count];

  // Appends those of the sources first, first + 1, ... whose bit is set.
  void add(Index first, const LaneVec3& place, unsigned lanes) {
    append(x + count, place.x, lanes), append(y + count, place.y, lanes), append(z + count, place.z, lanes);
    Index* end = append<1>(number + count, number + count + lane_count, first, lanes);
    count = static_cast<Index>(end - number);
  }
};

// Finds the neighbours of targets that are all of one cell.
template <class Box>
struct GroupSearch {
  Search<Box> search;
  int range;  // cells up to so many away hold all that may be within reach

  // The sources within reach of the box around targets first to last-1; false when there are too many.
  bool gather_candidates(Index cell, Index first, Index last, Candidates& near) const {
    near.count = 0;
    if (search.occupied.size > 0 && !search.occupied[cell]) return true;
    Vec3 lower = xyz(search.targets[first]), upper = lower;
    for (Index i = first + 1; i < last; ++i)
      for (int k = 0; k < 3; ++k) {
        const Real a = xyz(search.targets[i])[k];
        lower[k] = smaller(lower[k], a), upper[k] = larger(upper[k], a);
      }
    const LaneVec3 centre = in_lanes(Real(0.5) * (lower + upper));
    const Vec3 half = Real(0.501) * (upper - lower);  // rounding must not lose a source
    const Lanes limit = square(Real(1.001) * search.reach);
    bool fits = true;
    const auto visit = [&](Index from, Index to) {
      const Index stop = search.sources.cell_start[to + 1];
      for (Index j = search.sources.cell_start[from]; j < stop && fits; j += lane_count) {
        const LaneVec3 place = xyz(load_lanes(search.sources.place, j));
        const LaneVec3 d = search.box.separation(place, centre);
        const Lanes x = larger(magnitude(d.x) - half.x, Lanes(0)),
                    y = larger(magnitude(d.y) - half.y, Lanes(0)),
                    z = larger(magnitude(d.z) - half.z, Lanes(0));
        unsigned lanes = bits(x * x + y * y + z * z < limit);
        if (stop - j < lane_count) lanes &= (1u << (stop - j)) - 1;
        near.add(j, place, lanes);
        fits = near.count <= Candidates::most - lane_count;
      }
    };
    search.sources.grid.for_runs_around(cell, range, visit);
    // Targets that are sources follow each other among the candidates too.
    Index place = 0;
    while (search.self && place < near.count && near.number[place] != first) ++place;
    near.own = place - first;
    return fits;
  }

  // The neighbours of target i among them, to `to`, where there is room for whole lanes; their number.
  Index find(Index i, const Candidates& near, Index* to) const {
    const LaneVec3 centre = in_lanes(xyz(search.targets[i]));
    const Lanes limit = square(search.reach);
    const Index own = near.own + i;
    Index* at = to;
    for (Index k = 0; k < near.count; k += lane_count) {
      const LaneVec3 place{load_lanes(near.x + k), load_lanes(near.y + k), load_lanes(near.z + k)};
      const LaneVec3 d = search.box.separation(centre, place);
      unsigned lanes = bits(dot(d, d) < limit);
      if (near.count - k < lane_count) lanes &= (1u << (near.count - k)) - 1;
      if (search.self && own >= k && own < k + lane_count) lanes &= ~(1u << (own - k));
      at = append(at, near.number + k, lanes);
    }
    return fill_up(to, at);
  }

  // The same of all sources around the cell, not gathered, with what fills up the last lanes.
  std::vector<Index> find_alone(Index i, Index cell, Index& n) const {
    std::vector<Index> found;
    const LaneVec3 centre = in_lanes(xyz(search.targets[i]));
    search.sources.grid.for_runs_around(cell, range, [&](Index first, Index last) {
      search.find_in(first, last, i, centre, [&](Index j, unsigned lanes) {
        for (; lanes; lanes &= lanes - 1) found.push_back(j + __builtin_ctz(lanes));
      });
    });
    n = static_cast<Index>(found.size());
    if (n > 0) found.resize(static_cast<std::size_t>(whole_lanes(n)), found.back());
    return found;
  }

 private:
  // What fills up the last lanes may be read, but counts for nothing.
  static Index fill_up(Index* to, const Index* at) {
    const auto n = static_cast<Index>(at - to);
    for (Index k = n; k < whole_lanes(n); ++k) to[k] = to[n - 1];
    return n;
  }
};

// Where rows are stored, each in one piece.
struct RowStore {
  Span<Offset> row;
  Span<Index> length;
  Span<std::uint8_t> room;  // in registers()
  Span<Code> code;  // too short: nothing is written beyond its end, and used[0] tells how long it must be
  Span<Offset> used;

  // Takes new room for row i, for n entries and `spare` registers.
  void take(Index i, Index n, Index spare) const {
    const Offset wanted = whole_lanes(n) + static_cast<Offset>(spare) * lane_count;
    row[i] = reserve(used, wanted);
    room[i] = registers(static_cast<Index>(wanted));
  }
  // n entries of row i and what fills up their last lanes, where it has its room.
  void put(Index i, const Index* entries, Index n) const {
    const Offset begin = row[i], end = begin + whole_lanes(n);
    if (end > code.size) return;
    for (Offset k = begin; k < end; ++k) code[k] = static_cast<Code>(entries[k - begin]);
  }
};

struct KeepMisfits {
  Offset* misfits;
  HOST_DEVICE void operator()(const Terms<1>& all) const { *misfits = static_cast<Offset>(all.value[0]); }
};

// Fills the rows of `targets_per_piece` targets. Rows are collected first; where they go in the list is
// settled when there are enough of them, in any order: what a row holds does not depend on it.
template <class Box>
struct FillPiece {
  static constexpr Index targets_per_piece = 256;
  static constexpr Index grain = 1;    // pieces that a thread takes at a time
  static constexpr Index room = 8192;  // entries collected

  GroupSearch<Box> group;
  RowStore store;

  struct Collected {
    Index first = 0, count = 0;  // rows
    Index size = 0;              // entries
    Index entries[room];
  };

  void operator()(Index piece) const {
    const auto& search = group.search;
    const Index begin = piece * targets_per_piece;
    const Index end =
        static_cast<Index>(smaller(static_cast<Offset>(begin) + targets_per_piece, search.targets.size));
    Candidates near;
    Collected rows;
    rows.first = begin;
    for (Index first = begin; first < end;) {
      const Index cell = cell_of(first);
      Index last = first + 1;
      while (last < end && cell_of(last) == cell) ++last;
      if (group.gather_candidates(cell, first, last, near))
        for (Index i = first; i < last; ++i) collect(i, near, rows);
      else
        for (Index i = first; i < last; ++i) search_alone(i, cell, rows);
      first = last;
    }
    flush(rows);
  }

 private:
  Index cell_of(Index i) const { return group.search.sources.grid.cell_of(xyz(group.search.targets[i])); }

  void collect(Index i, const Candidates& near, Collected& rows) const {
    if (rows.size + near.count + 2 * lane_count > room) flush(rows);
    const Index n = group.find(i, near, rows.entries + rows.size);
    store.length[i] = n;
    store.row[i] = rows.size;  // from the first collected row, until they are stored
    store.room[i] = registers(n);
    rows.size += static_cast<Index>(whole_lanes(n));
    ++rows.count;
  }

  // A row among so many sources that they were not gathered.
  void search_alone(Index i, Index cell, Collected& rows) const {
    flush(rows);
    Index n = 0;
    const std::vector<Index> found = group.find_alone(i, cell, n);
    store.take(i, n, 0);
    store.length[i] = n;
    rows.first = i + 1;
    store.put(i, found.data(), n);
  }

  void flush(Collected& rows) const {
    const Offset begin = reserve(store.used, rows.size);
    for (Index i = rows.first; i < rows.first + rows.count; ++i) {
      const Index* entries = rows.entries + store.row[i];
      store.row[i] += begin;
      store.put(i, entries, store.length[i]);
    }
    rows.first += rows.count;
    rows.count = rows.size = 0;
  }
};

// Fills the rows of worn cells anew, where they are when they fit, or else in new room.
template <class Box>
struct RefillCell {
  static constexpr Index grain = 16;  // cells that a thread takes at a time

  GroupSearch<Box> group;
  RowStore store;
  Span<const Index> target_start;  // of each cell
  Span<const std::uint8_t> worn;   // of each cell

  void operator()(Index cell) const {
    const Index first = target_start[cell], last = target_start[cell + 1];
    if (!worn[cell] || first == last) return;
    Candidates near;
    if (group.gather_candidates(cell, first, last, near)) {
      Index entries[Candidates::most + lane_count];
      for (Index i = first; i < last; ++i) keep(i, entries, group.find(i, near, entries));
    } else {
      for (Index i = first; i < last; ++i) {
        Index n = 0;
        const std::vector<Index> found = group.find_alone(i, cell, n);
        keep(i, found.data(), n);
      }
    }
  }

 private:
  void keep(Index i, const Index* entries, Index n) const {
    constexpr Index spare = 1;
    store.length[i] = n;
    if (whole_lanes(n) > static_cast<Offset>(store.room[i]) * lane_count) store.take(i, n, spare);
    store.put(i, entries, n);
  }
};

}  // namespace slagflow
