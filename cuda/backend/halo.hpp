// Rows that belong to other ranks, behind a rank's own: copies, which an exchange makes those of now.
#pragma once

#include <array>
#include <initializer_list>

#include "backend/buffer.hpp"
#include "backend/rows.hpp"
#include "backend/slabs.hpp"

namespace slagflow {

struct Halo {
  Index own = 0, above = 0, below = 0;  // rows, in this order
  Index to_above = 0, to_below = 0;     // of its own, the last and the first, that the neighbours want
  int rank_above = -1, rank_below = -1;
  Index all = 0;  // rows of all ranks
  const Slabs* slabs = nullptr;

  Index rows() const { return own + above + below; }
};

// Which of all rows, in the order of the ranks, a rank has. A call of all ranks.
struct PartOfRows {
  Offset first = 0, own = 0, all = 0;
  PartOfRows() = default;
  explicit PartOfRows(Offset rows);
};

// The rows of all ranks, in their order; on the first rank, or on all.
enum class On { first_rank, all_ranks };
template <class T>
std::vector<T> rows_of_all(const Buffer<T>& values, const Rows& rows, On where) {
  std::vector<T> own;
  values.download(own);
  if (!rows.halo) return own;
  own.resize(static_cast<std::size_t>(rows.now));
  return where == On::all_ranks ? ranks().gathered(own) : ranks().gathered_on_first(own);
}

inline Index Rows::of_all() const { return halo ? halo->all : now; }

struct HaloField {
  void* data = nullptr;
  std::size_t element = 0;  // bytes
};

// In one message to each neighbour.
void exchange(Context&, const Halo&, const HaloField* fields, int count);

// Makes the copies behind the rows, in each buffer, those of now. Nothing where there are none.
template <class... T>
void exchange(Context& context, const Rows& rows, Buffer<T>&... values) {
  if (!rows.halo) return;
  const std::array<HaloField, sizeof...(T)> fields{HaloField{values.span().data, sizeof(T)}...};
  exchange(context, *rows.halo, fields.data(), static_cast<int>(fields.size()));
}

// For tests, with SLAGFLOW_POISON_HALOS in the environment: what must not be read before the next exchange
// becomes not-a-number.
bool halos_are_poisoned();
void poison(Context&, const Halo&, const HaloField&);
template <class... T>
void poison(Context& context, const Rows& rows, Buffer<T>&... values) {
  if (rows.halo && halos_are_poisoned())
    (poison(context, *rows.halo, HaloField{values.span().data, sizeof(T)}), ...);
}

// Whether a loop steered by this number on the device goes on.
bool goes_on_with(Context&, const std::int32_t* flag);

// The same where the number is not zero, or none of several is; it is the same on all ranks.
template <class... T>
void exchange_while(Context& context, const Rows& rows, const std::int32_t* flag, Buffer<T>&... values) {
  if (rows.halo && goes_on_with(context, flag)) exchange(context, rows, values...);
}
template <class... T>
void exchange_unless(Context& context, const Rows& rows, std::initializer_list<const std::int32_t*> flags,
                     Buffer<T>&... values) {
  if (!rows.halo) return;
  for (const std::int32_t* flag : flags)
    if (goes_on_with(context, flag)) return;
  exchange(context, rows, values...);
}

// Of an array that all ranks have, each gives what it has made, `count` elements from `first` on, in the
// order of the ranks.
void gather_parts(Context&, void* data, std::size_t first, std::size_t bytes);
template <class T>
void gather_parts(Context& context, Buffer<T>& values, Offset first, Offset count) {
  gather_parts(context, values.span().data, static_cast<std::size_t>(first) * sizeof(T),
               static_cast<std::size_t>(count) * sizeof(T));
}

// What each rank has of its planes, so many numbers of a plane and of what is behind them, for all planes:
// those of the first rank, ...
std::vector<double> gather_planes(const Halo&, const std::vector<double>& own, int numbers);

}  // namespace slagflow
