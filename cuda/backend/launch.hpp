// Runs a body once for each i in [0, n): a CUDA kernel, or an OpenMP loop in the CPU build.
// A body is a small struct with `HOST_DEVICE void operator()(Index i) const` that writes only element i.
// Where it has `HOST_DEVICE bool idle() const`, the device looks there first: when idle, nothing runs.
#pragma once

#include <type_traits>

#include "backend/context.hpp"
#include "backend/platform.hpp"
#include "backend/rows.hpp"

#if defined(__CUDACC__)
#include "backend/check.hpp"
#endif

namespace slagflow {

template <class Body, class = void>
struct CanIdle : std::false_type {};
template <class Body>
struct CanIdle<Body, std::void_t<decltype(&Body::idle)>> : std::true_type {};

template <class Body>
HOST_DEVICE bool is_idle(const Body& body) {
  if constexpr (CanIdle<Body>::value)
    return body.idle();
  else
    return false;
}

#if defined(__CUDACC__)

inline constexpr unsigned block_threads = chunk_rows;
inline unsigned blocks_for(Index n) { return (static_cast<unsigned>(n) + block_threads - 1) / block_threads; }

// What a launch is made for: a recording is to hold for any number of elements that there is room for.
inline Rows to_launch(const Context& context, Rows n) {
  return context.recording() && n.live ? Rows{n.room, n.room, n.live, n.planes}
                                       : Rows{n.now, n.now, nullptr, n.planes};
}

template <class Body>
__global__ void run_body(Body body, Rows n) {
  if (is_idle(body)) return;
  const Offset i = static_cast<Offset>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n.on_device()) body(static_cast<Index>(i));
}

template <class Body>
void launch(Context& context, const char* label, Rows rows, const Body& body) {
  const Rows n = to_launch(context, rows);
  if (n <= 0) return;
  context.count_launch();
  run_body<<<blocks_for(n), block_threads, 0, static_cast<cudaStream_t>(context.stream())>>>(body, n);
  check(cudaGetLastError(), label);
}

#else

// How many times in a row a thread runs the body: Body::grain, or a number that suits one particle a time.
template <class Body, class = void>
struct Grain {
  static constexpr Index value = 256;
};
template <class Body>
struct Grain<Body, std::void_t<decltype(Body::grain)>> {
  static constexpr Index value = Body::grain;
};

template <class Body>
void launch(Context&, const char*, Rows rows, const Body& body) {
  const Index n = rows;
  if (is_idle(body)) return;
  constexpr Index grain = Grain<Body>::value;
#pragma omp parallel for schedule(dynamic, grain) if (n > 2 * grain)
  for (Index i = 0; i < n; ++i) body(i);
}

#endif

}  // namespace slagflow
