// A borrowed run of elements; where they live (host or device) is the caller's business.
#pragma once

#include <type_traits>

#include "backend/platform.hpp"

namespace slagflow {

template <class T>
struct Span {
  T* data = nullptr;
  Offset size = 0;

  HOST_DEVICE Span() {}
  HOST_DEVICE Span(T* first, Offset count) : data(first), size(count) {}
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  HOST_DEVICE Span(Span<U> other) : data(other.data), size(other.size) {}

  HOST_DEVICE T& operator[](Offset i) const { return data[i]; }
};

}  // namespace slagflow
