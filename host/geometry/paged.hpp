// An array over the sites of a lattice of which most hold the same value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slagflow {

// Only the pages that hold another value take memory.
template <class T>
class Paged {
 public:
  static constexpr std::size_t length = 64;  // of a page

  Paged(std::size_t size, T rest)
      : page_((size + length - 1) / length, 0), values_(length, rest), rest_(rest) {}

  T operator[](std::size_t at) const { return values_[page_[at / length] * length + at % length]; }

  void set(std::size_t at, T value) {
    std::uint32_t& page = page_[at / length];
    if (page == 0) {
      page = static_cast<std::uint32_t>(values_.size() / length);
      values_.resize(values_.size() + length, rest_);
    }
    values_[page * length + at % length] = value;
  }

  // Calls visit(at, value) for all values of pages that hold others, in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t p = 0; p < page_.size(); ++p)
      for (std::size_t k = 0; page_[p] != 0 && k < length; ++k)
        if (values_[page_[p] * length + k] != rest_) visit(p * length + k, values_[page_[p] * length + k]);
  }

 private:
  std::vector<std::uint32_t> page_;  // of each `length` values; the first is all at rest
  std::vector<T> values_;            // page by page
  T rest_;
};

}  // namespace slagflow
