#include "backend/launch.hpp"
#include "backend/plane_table.hpp"
#include "backend/primitives.hpp"

namespace slagflow {

namespace {

struct CountChunks {
  PlaneStarts planes;
  Span<Offset> chunks;
  HOST_DEVICE void operator()(Index p) const {
    chunks[p] = (planes(p + 1) - planes(p) + chunk_rows - 1) / chunk_rows;
  }
};

// The chunks of each plane; the last says where all end.
struct ListChunks {
  PlaneStarts planes;
  Span<Offset> first_chunk;
  Span<Index> first_row;
  HOST_DEVICE void operator()(Index p) const {
    const Offset end = first_chunk[p + 1];
    Index row = planes(p);
    for (Offset c = first_chunk[p]; c < end; ++c, row += chunk_rows) first_row[c] = row;
    if (p + 1 < planes.count) return;
    first_row[end] = planes(planes.count);
    first_chunk[planes.count + 1] = planes(planes.count);
  }
};

}  // namespace

void PlaneTable::find(const PlaneStarts& planes, Index room) {
  if (count_ != planes.count) context_.arrange_anew();
  count_ = planes.count;
  chunks_.resize(count_), first_chunk_.resize(count_ + 2);
  first_row_.resize(Rows(room, room, nullptr, view()).most_chunks(room) + 1);
  launch(context_, "chunks of planes", count_, CountChunks{planes, chunks_.span()});
  exclusive_scan(context_, chunks_.span(), {first_chunk_.span().data, count_ + 1});
  launch(context_, "chunks of rows", count_, ListChunks{planes, first_chunk_.span(), first_row_.span()});
}

}  // namespace slagflow
