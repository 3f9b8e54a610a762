// Room in an array that several threads fill.
#pragma once

#include "backend/span.hpp"

namespace slagflow {

// Takes `count` places behind those taken before and returns the first of them. used[0] counts all of them.
// On the CPU only.
inline Offset reserve(Span<Offset> used, Offset count) {
  return __atomic_fetch_add(used.data, count, __ATOMIC_RELAXED);
}

}  // namespace slagflow
