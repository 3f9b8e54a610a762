// Where planes of rows and their chunks begin, on the device.
#pragma once

#include "backend/buffer.hpp"
#include "backend/rows.hpp"

namespace slagflow {

// Planes that follow each other: plane p is of the rows [start[p * each], start[(p + 1) * each]).
struct PlaneStarts {
  Span<const Index> start;
  Index each, count;
  HOST_DEVICE Index operator()(Index plane) const { return start[static_cast<Offset>(plane) * each]; }
};

class PlaneTable {
 public:
  explicit PlaneTable(Context& c)
      : context_(c),
        chunks_(c, "chunks of planes"),
        first_chunk_(c, "planes of rows"),
        first_row_(c, "chunks of rows") {}

  // Keeps its place, for recorded launches, while `room` and the number of planes stay.
  void find(const PlaneStarts&, Index room);

  Planes view() const { return {count_, first_chunk_.span().data, first_row_.span().data}; }

 private:
  Context& context_;
  Index count_ = 0;
  Buffer<Offset> chunks_, first_chunk_;
  Buffer<Index> first_row_;
};

}  // namespace slagflow
