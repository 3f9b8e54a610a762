// The search for neighbours as a CPU does it: particles that follow each other in one cell look at the same
// surroundings, so these are copied once, next to each other, and then compared in vector lanes. (On a GPU a
// thread searches for one particle: search.hpp.)
#pragma once

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

// Fills the rows of `targets_per_piece` targets. Rows are collected first; where they go in the list is
// settled when there are enough of them, in any order: what a row holds does not depend on it.
template <class Box>
struct FillPiece {
  static constexpr Index targets_per_piece = 256;
  static constexpr Index grain = 1;    // pieces that a thread takes at a time
  static constexpr Index room = 8192;  // entries collected

  Search<Box> search;
  Span<Offset> row;
  Span<Index> length;
  Span<Index> entry;  // too short: nothing is written beyond its end, and `used` tells how long it must be
  Span<Offset> used;

  struct Collected {
    Index first = 0, count = 0;  // rows
    Index size = 0;              // entries
    Index entries[room];
  };

  void operator()(Index piece) const {
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
      if (gather_candidates(cell, first, last, near))
        for (Index i = first; i < last; ++i) collect(i, near, rows);
      else
        for (Index i = first; i < last; ++i) search_alone(i, rows);
      first = last;
    }
    flush(rows);
  }

 private:
  Index cell_of(Index i) const { return search.sources.grid.cell_of(xyz(search.targets[i])); }

  // The sources within reach of the box around targets first to last-1, all of one cell; false when there are
  // too many.
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
    search.sources.grid.for_runs_around(cell, search.range, visit);
    // Targets that are sources follow each other among the candidates too.
    Index place = 0;
    while (search.self && place < near.count && near.number[place] != first) ++place;
    near.own = place - first;
    return fits;
  }

  void collect(Index i, const Candidates& near, Collected& rows) const {
    if (rows.size + near.count + 2 * lane_count > room) flush(rows);
    const LaneVec3 centre = in_lanes(xyz(search.targets[i]));
    const Lanes limit = square(search.reach);
    const Index own = near.own + i;
    Index* const start = rows.entries + rows.size;
    Index* at = start;
    for (Index k = 0; k < near.count; k += lane_count) {
      const LaneVec3 place{load_lanes(near.x + k), load_lanes(near.y + k), load_lanes(near.z + k)};
      const LaneVec3 d = search.box.separation(centre, place);
      unsigned lanes = bits(dot(d, d) < limit);
      if (near.count - k < lane_count) lanes &= (1u << (near.count - k)) - 1;
      if (search.self && own >= k && own < k + lane_count) lanes &= ~(1u << (own - k));
      at = append(at, near.number + k, lanes);
    }
    finish_row(i, static_cast<Index>(at - start), rows);
  }

  // A row among so many sources that they were not gathered.
  void search_alone(Index i, Collected& rows) const {
    flush(rows);
    Index n = 0;
    search(i, [&](Index, unsigned lanes) { n += number_of(lanes); });
    const Offset begin = reserve(used, whole_lanes(n));
    row[i] = begin, length[i] = n;
    rows.first = i + 1;
    if (begin + whole_lanes(n) > entry.size) return;
    Index* at = &entry[begin];
    const Index* end = at + whole_lanes(n);
    search(i, [&](Index j, unsigned lanes) { at = append<1>(at, end, j, lanes); });
    while (at < end) *at++ = search.self ? i : 0;
  }

  void finish_row(Index i, Index n, Collected& rows) const {
    Index* const start = rows.entries + rows.size;
    for (Index k = n; k < whole_lanes(n); ++k) start[k] = search.self ? i : 0;
    length[i] = n;
    row[i] = rows.size;  // from the first collected row, until they are stored
    rows.size += static_cast<Index>(whole_lanes(n));
    ++rows.count;
  }

  void flush(Collected& rows) const {
    const Offset begin = reserve(used, rows.size);
    for (Index k = 0; k < rows.count; ++k) row[rows.first + k] += begin;
    if (begin + rows.size <= entry.size)
      for (Index k = 0; k < rows.size; ++k) entry[begin + k] = rows.entries[k];
    rows.first += rows.count;
    rows.count = rows.size = 0;
  }
};

}  // namespace slagflow
