#include <cstring>

#include "fluid/migration.hpp"

namespace slagflow {

namespace {

using Bytes = std::vector<std::byte>;

std::size_t bytes_of_row(const ParticleArrays& arrays) {
  std::size_t bytes = 0;
  arrays.each(Fate::sorted,
              [&](const auto& array) { bytes += sizeof(typename std::decay_t<decltype(array)>::Element); });
  return bytes;
}

// Array by array.
Bytes packed(const ParticleArrays& arrays, Index first, Index count) {
  Bytes result(bytes_of_row(arrays) * static_cast<std::size_t>(count));
  std::size_t at = 0;
  arrays.each(Fate::sorted, [&](const auto& array) {
    const std::size_t bytes =
        sizeof(typename std::decay_t<decltype(array)>::Element) * static_cast<std::size_t>(count);
    arrays.context.copy_to_host(result.data() + at, array.span().data + first, bytes);
    at += bytes;
  });
  return result;
}

void unpack(const Bytes& from, const ParticleArrays& arrays, Index first, Index count) {
  std::size_t at = 0;
  arrays.each(Fate::sorted, [&](auto& array) {
    const std::size_t bytes =
        sizeof(typename std::decay_t<decltype(array)>::Element) * static_cast<std::size_t>(count);
    arrays.context.copy_to_device(array.span().data + first, from.data() + at, bytes);
    at += bytes;
  });
}

}  // namespace

Index migrate(ParticleArrays& arrays, Index kept, const std::vector<Index>& leaving) {
  std::vector<Bytes> send;
  Index first = kept;
  for (const Index count : leaving) send.push_back(packed(arrays, first, count)), first += count;
  const std::vector<Bytes> came = ranks().dealt(send);
  const std::size_t row = bytes_of_row(arrays);
  std::size_t all = 0;
  for (const Bytes& bytes : came) all += bytes.size() / row;
  arrays.resize(kept + static_cast<Index>(all));
  first = kept;
  for (const Bytes& bytes : came) {
    const auto count = static_cast<Index>(bytes.size() / row);
    unpack(bytes, arrays, first, count);
    first += count;
  }
  return arrays.count;
}

Halo meet_neighbours(const Slabs& slabs, Index own, const Borders& borders) {
  constexpr int upwards = 1, downwards = 2;
  const int rank = ranks().rank();
  Halo halo;
  halo.own = own;
  halo.slabs = &slabs;
  halo.rank_above = slabs.above(rank), halo.rank_below = slabs.below(rank);
  halo.to_above = halo.rank_above >= 0 ? borders.to_above : 0;
  halo.to_below = halo.rank_below >= 0 ? borders.to_below : 0;
  const auto message = [](int to, const Index& send, int send_tag, Index& receive, int receive_tag) {
    return Message{to,
                   reinterpret_cast<const std::byte*>(&send),
                   sizeof send,
                   reinterpret_cast<std::byte*>(&receive),
                   sizeof receive,
                   send_tag,
                   receive_tag};
  };
  ranks().exchange({message(halo.rank_above, halo.to_above, upwards, halo.above, downwards),
                    message(halo.rank_below, halo.to_below, downwards, halo.below, upwards)});
  halo.all = static_cast<Index>(ranks().added(own));
  return halo;
}

void exchange_all(const ParticleArrays& arrays) {
  std::vector<HaloField> fields;
  arrays.each(Fate::sorted, [&](auto& array) {
    fields.push_back({array.span().data, sizeof(typename std::decay_t<decltype(array)>::Element)});
  });
  exchange(arrays.context, *arrays.count.halo, fields.data(), static_cast<int>(fields.size()));
}

}  // namespace slagflow
