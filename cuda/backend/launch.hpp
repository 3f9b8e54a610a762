// Runs a body once for each i in [0, n): a CUDA kernel, or an OpenMP loop in the CPU build.
// A body is a small struct with `HOST_DEVICE void operator()(Index i) const` that writes only element i.
#pragma once

#include <type_traits>

#include "backend/context.hpp"
#include "backend/platform.hpp"

#if defined(__CUDACC__)
#include "backend/check.hpp"
#endif

namespace slagflow {

#if defined(__CUDACC__)

template <class Body>
__global__ void run_body(Body body, Index n) {
  const Offset i = static_cast<Offset>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n) body(static_cast<Index>(i));
}

template <class Body>
void launch(Context& context, const char* label, Index n, const Body& body) {
  if (n <= 0) return;
  constexpr unsigned threads = 128;
  const unsigned blocks = (static_cast<unsigned>(n) + threads - 1) / threads;
  run_body<<<blocks, threads, 0, static_cast<cudaStream_t>(context.stream())>>>(body, n);
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
void launch(Context&, const char*, Index n, const Body& body) {
  constexpr Index grain = Grain<Body>::value;
#pragma omp parallel for schedule(dynamic, grain) if (n > 2 * grain)
  for (Index i = 0; i < n; ++i) body(i);
}

#endif

}  // namespace slagflow
