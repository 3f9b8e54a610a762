// How many elements there are, where launches may be recorded for a graph: a graph outlives a change of the
// number, as its kernels look it up.
#pragma once

#include "backend/platform.hpp"

namespace slagflow {

struct Rows {
  Index now = 0;
  Index room = 0;               // for how many there is memory, and how many a recording reckons with
  const Index* live = nullptr;  // the same as `now`, on the device; null: it never changes

  Rows() = default;
  HOST_DEVICE Rows(Index count) : now(count), room(count) {}
  HOST_DEVICE Rows(Index count, Index most, const Index* on_device)
      : now(count), room(most), live(on_device) {}
  HOST_DEVICE operator Index() const { return now; }

  // Where a body needs it that may have been recorded.
  HOST_DEVICE Index on_device() const {
#if defined(__CUDA_ARCH__)
    return live ? *live : now;
#else
    return now;
#endif
  }
};

}  // namespace slagflow
