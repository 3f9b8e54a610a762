// Sums and maxima over particles that stay on the device: a last body takes them there, and the host need not
// wait. The order of summation is fixed.
#pragma once

#include "backend/launch.hpp"
#include "backend/primitives.hpp"

namespace slagflow {

// What a body gives for one element, and what comes of all: some numbers, reduced one by one.
template <int count>
struct Terms {
  double value[count];
};

struct AddUp {
  static constexpr double start = 0;
  HOST_DEVICE static double combine(double a, double b) { return a + b; }
};

// Not-a-number wins.
struct TakeLargest {
  static constexpr double start = -1e30;
  HOST_DEVICE static double combine(double a, double b) { return a != a || a > b ? a : b; }
};

#if defined(__CUDACC__)

template <class Reduction, int count>
__device__ Terms<count> across_block(Terms<count> own) {
  constexpr unsigned warp = 32, warps = block_threads / warp;
  __shared__ double of_warps[warps][count];
  for (int k = 0; k < count; ++k) {
    for (unsigned step = warp / 2; step > 0; step /= 2)
      own.value[k] = Reduction::combine(own.value[k], __shfl_down_sync(~0u, own.value[k], step));
    if (threadIdx.x % warp == 0) of_warps[threadIdx.x / warp][k] = own.value[k];
  }
  __syncthreads();
  for (int k = 0; k < count; ++k) {
    own.value[k] = of_warps[0][k];
    for (unsigned w = 1; w < warps; ++w) own.value[k] = Reduction::combine(own.value[k], of_warps[w][k]);
  }
  __syncthreads();
  return own;
}

template <class Reduction, int count>
__device__ Terms<count> nothing() {
  Terms<count> terms;
  for (double& value : terms.value) value = Reduction::start;
  return terms;
}

// Each block leaves its share in `partial`; the one that comes last, by `ticket`, reduces the shares in
// order.
template <class Reduction, class Body, class Finish>
__global__ void run_reduction(Body body, Rows n, Finish finish, volatile double* partial, unsigned* ticket) {
  if (is_idle(body)) return;
  constexpr int count = Body::terms;
  const Offset i = static_cast<Offset>(blockIdx.x) * blockDim.x + threadIdx.x;
  Terms<count> own = nothing<Reduction, count>();
  if (i < n.on_device()) own = body(static_cast<Index>(i));
  own = across_block<Reduction>(own);
  __shared__ bool last;
  if (threadIdx.x == 0) {
    for (int k = 0; k < count; ++k) partial[static_cast<Offset>(blockIdx.x) * count + k] = own.value[k];
    __threadfence();
    last = atomicInc(ticket, gridDim.x - 1) == gridDim.x - 1;  // ends at zero, for the next reduction
  }
  __syncthreads();
  if (!last) return;
  __threadfence();
  own = nothing<Reduction, count>();
  for (Offset block = threadIdx.x; block < gridDim.x; block += blockDim.x)
    for (int k = 0; k < count; ++k)
      own.value[k] = Reduction::combine(own.value[k], partial[block * count + k]);
  own = across_block<Reduction>(own);
  if (threadIdx.x == 0) finish(own);
}

// Takes the memory of reductions over up to n elements of up to `terms` terms, so that they can be recorded.
inline void reserve_reductions(Context& context, Index n, int terms) {
  const unsigned blocks = n > 0 ? blocks_for(n) : 1;
  context.workspace(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(terms) * sizeof(double));
  context.ticket();
}

// Reduces body(i), Terms<Body::terms> each, over i in [0, n), and runs finish(result) once. Where the body is
// idle, neither runs.
template <class Reduction, class Body, class Finish>
void launch_reduction(Context& context, const char* label, Rows rows, const Body& body,
                      const Finish& finish) {
  const Rows n = to_launch(context, rows);
  const unsigned blocks = n > 0 ? blocks_for(n) : 1;
  auto* partial =
      static_cast<double*>(context.workspace(static_cast<std::size_t>(blocks) * sizeof(Terms<Body::terms>)));
  context.count_launch();
  run_reduction<Reduction><<<blocks, block_threads, 0, static_cast<cudaStream_t>(context.stream())>>>(
      body, n, finish, partial, static_cast<unsigned*>(context.ticket()));
  check(cudaGetLastError(), label);
}

#else

inline void reserve_reductions(Context&, Index, int) {}

template <class Body>
struct StoreTerms {
  Body body;
  Index n;
  double* result;
  HOST_DEVICE void operator()(Index i) const {
    const Terms<Body::terms> own = body(i);
    for (int k = 0; k < Body::terms; ++k) result[static_cast<Offset>(k) * n + i] = own.value[k];
  }
};

inline double reduce(AddUp, Context& context, Span<const double> values) { return sum(context, values); }
inline double reduce(TakeLargest, Context& context, Span<const double> values) {
  return maximum(context, values, TakeLargest::start);
}

template <class Reduction, class Body, class Finish>
void launch_reduction(Context& context, const char* label, Rows rows, const Body& body,
                      const Finish& finish) {
  if (is_idle(body)) return;
  const Index n = rows;
  constexpr auto count = static_cast<std::size_t>(Body::terms);
  auto* values =
      static_cast<double*>(context.workspace(static_cast<std::size_t>(n) * count * sizeof(double)));
  launch(context, label, n, StoreTerms<Body>{body, n, values});
  Terms<Body::terms> result;
  for (std::size_t k = 0; k < count; ++k)
    result.value[k] = reduce(Reduction{}, context, {values + k * static_cast<std::size_t>(n), n});
  finish(result);
}

#endif

}  // namespace slagflow
