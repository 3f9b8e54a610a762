#include <cstdlib>
#include <cstring>
#include <vector>

#include "backend/halo.hpp"

namespace slagflow {

namespace {

struct Border {
  Index first, count;
};

// A message of some fields' rows, one field behind the other.
class Parcel {
 public:
  Parcel(Context& context, const HaloField* fields, int count)
      : context_(context), fields_(fields), count_(count) {}

  void take(const Border& rows) {
    for_fields(rows, [&](std::byte* here, void* there, std::size_t bytes) {
      context_.copy_to_host(here, there, bytes);
    });
  }
  void give(const Border& rows) {
    for_fields(rows, [&](std::byte* here, void* there, std::size_t bytes) {
      context_.copy_to_device(there, here, bytes);
    });
  }
  void make_room(const Border& rows) {
    std::size_t bytes = 0;
    for (int k = 0; k < count_; ++k) bytes += fields_[k].element * static_cast<std::size_t>(rows.count);
    bytes_.resize(bytes);
  }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  template <class Copy>
  void for_fields(const Border& rows, Copy copy) {
    std::size_t at = 0;
    for (int k = 0; k < count_; ++k) {
      const std::size_t element = fields_[k].element, bytes = element * static_cast<std::size_t>(rows.count);
      auto* data = static_cast<std::byte*>(fields_[k].data) + element * static_cast<std::size_t>(rows.first);
      if (bytes > 0) copy(bytes_.data() + at, data, bytes);
      at += bytes;
    }
  }

  Context& context_;
  const HaloField* fields_;
  int count_;
  std::vector<std::byte> bytes_;
};

}  // namespace

void exchange(Context& context, const Halo& h, const HaloField* fields, int count) {
  constexpr int upwards = 1, downwards = 2;
  Parcel to_above(context, fields, count), to_below = to_above, from_above = to_above, from_below = to_above;
  const Border top{h.own - h.to_above, h.to_above}, bottom{0, h.to_below};
  const Border above{h.own, h.above}, below{h.own + h.above, h.below};
  to_above.make_room(top), to_below.make_room(bottom);
  from_above.make_room(above), from_below.make_room(below);
  to_above.take(top), to_below.take(bottom);
  const auto message = [](int rank, Parcel& send, int send_tag, Parcel& receive, int receive_tag) {
    return Message{
        rank,     send.bytes().data(), send.bytes().size(), receive.bytes().data(), receive.bytes().size(),
        send_tag, receive_tag};
  };
  ranks().exchange({message(h.rank_above, to_above, upwards, from_above, downwards),
                    message(h.rank_below, to_below, downwards, from_below, upwards)});
  from_above.give(above), from_below.give(below);
}

bool halos_are_poisoned() {
  static const bool wish = std::getenv("SLAGFLOW_POISON_HALOS") != nullptr;
  return wish;
}

void poison(Context& context, const Halo& halo, const HaloField& field) {
  const auto first = static_cast<std::size_t>(halo.own) * field.element;
  const std::vector<std::byte> bad(static_cast<std::size_t>(halo.above + halo.below) * field.element,
                                   std::byte(0xff));
  context.copy_to_device(static_cast<std::byte*>(field.data) + first, bad.data(), bad.size());
}

PartOfRows::PartOfRows(Offset rows) : own(rows) {
  const std::vector<Offset> of_ranks = ranks().gathered(std::vector<Offset>{rows});
  for (std::size_t r = 0; r < of_ranks.size(); ++r) {
    if (static_cast<int>(r) < ranks().rank()) first += of_ranks[r];
    all += of_ranks[r];
  }
}

bool goes_on_with(Context& context, const std::int32_t* flag) {
  std::int32_t now = 0;
  context.copy_to_host(&now, flag, sizeof now);
  return now != 0;
}

void gather_parts(Context& context, void* data, std::size_t first, std::size_t bytes) {
  std::vector<std::byte> own(bytes);
  context.copy_to_host(own.data(), static_cast<const std::byte*>(data) + first, bytes);
  const std::vector<std::byte> all = ranks().gathered(own.data(), bytes);
  context.copy_to_device(data, all.data(), all.size());
}

std::vector<double> gather_planes(const Halo& halo, const std::vector<double>& own, int numbers) {
  std::vector<std::size_t> bytes;
  for (int r = 0; r < halo.slabs->ranks(); ++r)
    bytes.push_back(static_cast<std::size_t>(halo.slabs->own(r) + 1) * static_cast<std::size_t>(numbers) *
                    sizeof(double));
  return ranks().gathered_by(own, bytes);
}

}  // namespace slagflow
