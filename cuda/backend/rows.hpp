// How many elements there are, where launches may be recorded for a graph: a graph outlives a change of the
// number, as its kernels look it up. And in which pieces they are added up.
#pragma once

#include "backend/platform.hpp"

namespace slagflow {

// Of at most how many rows a piece is, whose sum is taken at once.
inline constexpr Index chunk_rows = 128;

// Rows in planes, one behind the other. No chunk reaches over the start of a plane. Tables on the device.
struct Planes {
  Index count = 0;
  const Offset* first_chunk = nullptr;  // of each plane; then the number of chunks, and that of rows
  const Index* first_row = nullptr;     // of each chunk; then the number of rows

  HOST_DEVICE Offset chunks() const { return count > 0 ? first_chunk[count] : 0; }
  HOST_DEVICE Offset rows() const { return count > 0 ? first_chunk[count + 1] : 0; }
};

struct Halo;

struct RowRange {
  Index first, end;
};

struct Rows {
  Index now = 0;
  Index room = 0;               // for how many there is memory, and how many a recording reckons with
  const Index* live = nullptr;  // the same as `now`, on the device; null: it never changes
  Planes planes;                // of the first rows; those behind them make one plane more
  const Halo* halo = nullptr;   // for the host: of a part of the rows, whose others are with other ranks

  Rows() = default;
  HOST_DEVICE Rows(Index count) : now(count), room(count) {}
  HOST_DEVICE Rows(Index count, Index most, const Index* on_device, Planes in = {})
      : now(count), room(most), live(on_device), planes(in) {}
  HOST_DEVICE operator Index() const { return now; }
  Index of_all() const;  // of all ranks (halo.hpp)

  // Where a body needs it that may have been recorded.
  HOST_DEVICE Index on_device() const {
#if defined(__CUDA_ARCH__)
    return live ? *live : now;
#else
    return now;
#endif
  }

  // In how many chunks so many rows may be.
  Offset most_chunks(Index count) const {
    return (count + static_cast<Offset>(chunk_rows - 1) * (planes.count + 1)) / chunk_rows;
  }

  // For bodies: the chunks, and those of plane p, [first_chunk(p), first_chunk(p + 1)), 0 <= p <=
  // planes.count.
  HOST_DEVICE Offset chunks() const {
    const Offset behind = on_device() - planes.rows();
    return planes.chunks() + (behind > 0 ? (behind + chunk_rows - 1) / chunk_rows : 0);
  }
  HOST_DEVICE Offset first_chunk(Index plane) const {
    if (plane > planes.count) return chunks();
    return planes.count > 0 ? planes.first_chunk[plane] : 0;
  }
  HOST_DEVICE RowRange chunk(Offset c) const {
    const Offset before = planes.chunks(), all = on_device();
    const Offset behind = planes.rows() + (c - before) * chunk_rows;
    const Offset first = c < before ? planes.first_row[c] : behind;
    const Offset full = c < before ? planes.first_row[c + 1] : behind + chunk_rows;
    return {static_cast<Index>(first), static_cast<Index>(full < all ? full : all)};
  }
};

}  // namespace slagflow
