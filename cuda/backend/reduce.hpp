// Sums and maxima over particles that stay on the device: a last body takes them there, and the host need not
// wait. The order of summation is fixed, and the same on both back ends: the terms of a chunk of rows, the
// chunks of a plane, the planes from the first to the last. So sums do not depend on who computes which of
// the planes, and an empty one changes nothing.
#pragma once

#include "backend/halo.hpp"
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

// Of an array.
struct ValueTerm {
  static constexpr int terms = 1;
  static constexpr Index grain = 4096;
  Span<const double> values;
  HOST_DEVICE Terms<1> operator()(Index i) const { return {{values[i]}}; }
};

// How many threads add up the chunks of a plane.
inline constexpr int plane_lanes = 8;

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

// What the chunks left in `partial`, of all rows in no planes.
template <class Reduction, int count>
__device__ Terms<count> of_chunks(Offset chunks, const volatile double* partial) {
  Terms<count> own = nothing<Reduction, count>();
  for (Offset chunk = threadIdx.x; chunk < chunks; chunk += block_threads)
    for (int k = 0; k < count; ++k)
      own.value[k] = Reduction::combine(own.value[k], partial[chunk * count + k]);
  return across_block<Reduction>(own);
}

// Plane by plane, some threads of a warp each. The first thread has the result.
template <class Reduction, int count>
__device__ Terms<count> of_planes(const Rows& n, const volatile double* partial) {
  constexpr Index at_once = block_threads / plane_lanes;
  __shared__ double sums[at_once][count];
  const auto thread = static_cast<Index>(threadIdx.x);
  const Index own_plane = thread / plane_lanes, lane = thread % plane_lanes;
  Terms<count> all = nothing<Reduction, count>();
  for (Index first = 0; first <= n.planes.count; first += at_once) {
    const Index plane = first + own_plane;
    const Offset end = plane <= n.planes.count ? n.first_chunk(plane + 1) : 0;
    Terms<count> own = nothing<Reduction, count>();
    for (Offset chunk = end > 0 ? n.first_chunk(plane) + lane : 0; chunk < end; chunk += plane_lanes)
      for (int k = 0; k < count; ++k)
        own.value[k] = Reduction::combine(own.value[k], partial[chunk * count + k]);
    for (int k = 0; k < count; ++k) {
      for (unsigned step = plane_lanes / 2; step > 0; step /= 2)
        own.value[k] = Reduction::combine(own.value[k], __shfl_down_sync(~0u, own.value[k], step));
      if (lane == 0) sums[own_plane][k] = own.value[k];
    }
    __syncthreads();
    for (Index p = 0; thread == 0 && p < at_once; ++p)
      for (int k = 0; k < count; ++k) all.value[k] = Reduction::combine(all.value[k], sums[p][k]);
    __syncthreads();
  }
  return all;
}

// A block a chunk leaves its share in `partial`; the one that comes last, by `ticket`, goes on with the
// shares. Without rows there is one block all the same. Those beyond the chunks do nothing.
template <class Reduction, class Body, class Finish>
__global__ void run_reduction(Body body, Rows n, Finish finish, volatile double* partial, unsigned* ticket) {
  const Offset chunk = blockIdx.x, found = n.chunks(), chunks = found > 0 ? found : 1;
  if (chunk >= chunks || is_idle(body)) return;
  constexpr int count = Body::terms;
  const RowRange rows = n.chunk(chunk);
  Terms<count> own = nothing<Reduction, count>();
  const Index i = rows.first + static_cast<Index>(threadIdx.x);
  if (i < rows.end) own = body(i);
  own = across_block<Reduction>(own);
  __shared__ bool last;
  if (threadIdx.x == 0) {
    for (int k = 0; k < count; ++k) partial[chunk * count + k] = own.value[k];
    __threadfence();
    const auto most = static_cast<unsigned>(chunks - 1);
    last = atomicInc(ticket, most) == most;  // ends at zero, for the next reduction
  }
  __syncthreads();
  if (!last) return;
  __threadfence();
  own = n.planes.count > 0 ? of_planes<Reduction, count>(n, partial)
                           : of_chunks<Reduction, count>(chunks, partial);
  if (threadIdx.x == 0) finish(own);
}

// With several ranks: what a chunk gives, what the chunks of a plane give, and what is done with that of all
// ranks. Where the body is idle, `idle` tells so.
template <class Reduction, class Body>
__global__ void reduce_chunks(Body body, Rows n, double* partial, std::int32_t* idle) {
  if (blockIdx.x == 0 && threadIdx.x == 0) *idle = is_idle(body) ? 1 : 0;
  const Offset chunk = blockIdx.x;
  if (chunk >= n.chunks() || is_idle(body)) return;
  const RowRange rows = n.chunk(chunk);
  Terms<Body::terms> own = nothing<Reduction, Body::terms>();
  const Index i = rows.first + static_cast<Index>(threadIdx.x);
  if (i < rows.end) own = body(i);
  own = across_block<Reduction>(own);
  for (int k = 0; threadIdx.x == 0 && k < Body::terms; ++k) partial[chunk * Body::terms + k] = own.value[k];
}

template <class Reduction, int count>
__global__ void reduce_planes(Rows n, const double* partial, double* sums) {
  const auto plane = static_cast<Index>(blockIdx.x), lane = static_cast<Index>(threadIdx.x);
  Terms<count> own = nothing<Reduction, count>();
  const Offset end = n.first_chunk(plane + 1);
  for (Offset chunk = n.first_chunk(plane) + lane; chunk < end; chunk += plane_lanes)
    for (int k = 0; k < count; ++k)
      own.value[k] = Reduction::combine(own.value[k], partial[chunk * count + k]);
  for (int k = 0; k < count; ++k) {
    constexpr unsigned lanes = (1u << plane_lanes) - 1;
    for (int step = plane_lanes / 2; step > 0; step /= 2) {
      const double other = __shfl_down_sync(lanes, own.value[k], step, plane_lanes);
      own.value[k] = Reduction::combine(own.value[k], other);
    }
    if (lane == 0) sums[static_cast<Offset>(plane) * count + k] = own.value[k];
  }
}

template <class Finish, int count>
__global__ void finish_with(Finish finish, Terms<count> all) {
  finish(all);
}

template <class Reduction, int count>
Terms<count> of_all_ranks(const Halo& halo, const std::vector<double>& own) {
  Terms<count> all{};
  if constexpr (std::is_same_v<Reduction, AddUp>) {
    const std::vector<double> planes = gather_planes(halo, own, count);
    for (std::size_t at = 0; at < planes.size(); ++at) all.value[at % count] += planes[at];
  } else {
    for (double& value : all.value) value = Reduction::start;
    for (std::size_t at = 0; at < own.size(); ++at)
      all.value[at % count] = Reduction::combine(all.value[at % count], own[at]);
    ranks().take_largest(all.value, count);
  }
  return all;
}

// Waits: sums of other ranks come by way of the host.
template <class Reduction, class Body, class Finish>
void reduce_together(Context& context, const char* label, const Rows& rows, const Body& body,
                     const Finish& finish) {
  constexpr int count = Body::terms;
  const Rows n = to_launch(context, rows);
  auto* const stream = static_cast<cudaStream_t>(context.stream());
  const auto chunks = static_cast<std::size_t>(n.most_chunks(n.now)),
             planes = static_cast<std::size_t>(n.planes.count) + 1;
  constexpr std::size_t each = count * sizeof(double);
  auto* memory = static_cast<std::byte*>(context.workspace((chunks + planes) * each + sizeof(std::int32_t)));
  auto *partial = reinterpret_cast<double*>(memory), *sums = partial + chunks * count;
  auto* flag = reinterpret_cast<std::int32_t*>(sums + planes * count);
  context.count_launch();
  const auto blocks = static_cast<unsigned>(chunks > 0 ? chunks : 1);
  reduce_chunks<Reduction><<<blocks, block_threads, 0, stream>>>(body, n, partial, flag);
  check(cudaGetLastError(), label);
  context.count_launch();
  reduce_planes<Reduction, count>
      <<<static_cast<unsigned>(planes), plane_lanes, 0, stream>>>(n, partial, sums);
  check(cudaGetLastError(), label);
  std::vector<std::byte> host(planes * each + sizeof(std::int32_t));
  context.copy_to_host(host.data(), sums, host.size());
  std::int32_t idle = 0;
  std::memcpy(&idle, host.data() + planes * each, sizeof idle);
  if (idle) return;
  std::vector<double> own(planes * count);
  std::memcpy(own.data(), host.data(), planes * each);
  context.count_launch();
  finish_with<<<1, 1, 0, stream>>>(finish, of_all_ranks<Reduction, count>(*rows.halo, own));
  check(cudaGetLastError(), label);
}

// Of a reduction over so many of the rows.
inline unsigned reduction_blocks(const Rows& n, Index count) {
  const Offset most = n.most_chunks(count);
  return most > 0 ? static_cast<unsigned>(most) : 1;
}

// Takes the memory of reductions of up to `terms` terms over as many elements as there is room for, so that
// they can be recorded.
inline void reserve_reductions(Context& context, const Rows& n, int terms) {
  const std::size_t blocks = reduction_blocks(n, n.room);
  context.workspace(blocks * static_cast<std::size_t>(terms) * sizeof(double));
  context.ticket();
}

// Reduces body(i), Terms<Body::terms> each, over i in [0, n), and runs finish(result) once. Where the body is
// idle, neither runs.
template <class Reduction, class Body, class Finish>
void launch_reduction(Context& context, const char* label, Rows rows, const Body& body,
                      const Finish& finish) {
  if (rows.halo) return reduce_together<Reduction>(context, label, rows, body, finish);
  const Rows n = to_launch(context, rows);
  const unsigned blocks = reduction_blocks(n, n.now);
  auto* partial =
      static_cast<double*>(context.workspace(static_cast<std::size_t>(blocks) * sizeof(Terms<Body::terms>)));
  context.count_launch();
  run_reduction<Reduction><<<blocks, block_threads, 0, static_cast<cudaStream_t>(context.stream())>>>(
      body, n, finish, partial, static_cast<unsigned*>(context.ticket()));
  check(cudaGetLastError(), label);
}

#else

inline void reserve_reductions(Context&, const Rows&, int) {}

// values[0] = their sum, as threads of a warp add up.
template <int count>
void add_as_tree(double* values) {
  for (int i = 0; i < count / 2; ++i) values[i] += values[i + count / 2];
  if constexpr (count > 2) add_as_tree<count / 2>(values);
}

// As across_block() does on a GPU. Changes the values.
inline double add_up_chunk(double* values) {
  constexpr int warp = 32;
  for (int first = 0; first < chunk_rows; first += warp) add_as_tree<warp>(values + first);
  for (int first = warp; first < chunk_rows; first += warp) values[0] += values[first];
  return values[0];
}

// Deals the values out to so many lanes.
template <int lanes>
void deal_out(const double* values, Offset count, double (&of_lane)[lanes]) {
  for (double& lane : of_lane) lane = 0;
  Offset first = 0;
  for (; first + lanes <= count; first += lanes)
    for (int lane = 0; lane < lanes; ++lane) of_lane[lane] += values[first + lane];
  for (int lane = 0; first + lane < count; ++lane) of_lane[lane] += values[first + lane];
}

// What of_chunks() and of_planes() do on a GPU.
inline double add_up_chunks(const Rows& n, const double* partial) {
  double lanes[chunk_rows];
  deal_out(partial, n.chunks(), lanes);
  return add_up_chunk(lanes);
}
inline double add_up_plane(const Rows& n, Index plane, const double* partial) {
  double lanes[plane_lanes];
  const Offset first = n.first_chunk(plane);
  deal_out(partial + first, n.first_chunk(plane + 1) - first, lanes);
  add_as_tree<plane_lanes>(lanes);
  return lanes[0];
}

// Of each term a sum a plane, and one of what is behind them. Those of all ranks are added in the order of
// the planes, so that the sum does not depend on how they are dealt out.
template <int count>
Terms<count> add_up_planes(const Rows& n, const double* partial, Offset chunks) {
  const Index sums = n.planes.count + 1;
  std::vector<double> of_planes(static_cast<std::size_t>(sums) * count);
  for (int k = 0; k < count; ++k)
    for (Index plane = 0; plane < sums; ++plane)
      of_planes[static_cast<std::size_t>(plane) * count + k] = add_up_plane(n, plane, partial + k * chunks);
  if (n.halo) of_planes = gather_planes(*n.halo, of_planes, count);
  Terms<count> all{};
  for (std::size_t at = 0; at < of_planes.size(); ++at) all.value[at % count] += of_planes[at];
  return all;
}

// The sum of each term over a chunk goes to result[0], result[stride], ...
template <class Body>
void add_up_rows(const Body& body, RowRange rows, double* result, Offset stride) {
  constexpr int count = Body::terms;
  double values[count][chunk_rows];
  const Index size = rows.end - rows.first;
  for (Index i = 0; i < size; ++i) {
    const Terms<count> own = body(rows.first + i);
    for (int k = 0; k < count; ++k) values[k][i] = own.value[k];
  }
  for (int k = 0; k < count; ++k) {
    for (Index i = size; i < chunk_rows; ++i) values[k][i] = 0;
    result[k * stride] = add_up_chunk(values[k]);
  }
}

template <class Body>
Terms<Body::terms> reduce(AddUp, Context& context, const Rows& n, const Body& body) {
  constexpr Offset grain = (Grain<Body>::value + chunk_rows - 1) / chunk_rows;
  const Offset chunks = n.chunks();
  auto* partial =
      static_cast<double*>(context.workspace(static_cast<std::size_t>(chunks) * sizeof(Terms<Body::terms>)));
#pragma omp parallel for schedule(dynamic, grain) if (chunks > 2 * grain)
  for (Offset c = 0; c < chunks; ++c) add_up_rows(body, n.chunk(c), partial + c, chunks);
  if (n.planes.count > 0) return add_up_planes<Body::terms>(n, partial, chunks);
  Terms<Body::terms> result;
  for (int k = 0; k < Body::terms; ++k) result.value[k] = add_up_chunks(n, partial + k * chunks);
  return result;
}

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

template <class Body>
Terms<Body::terms> reduce(TakeLargest, Context& context, const Rows& n, const Body& body) {
  constexpr auto count = static_cast<std::size_t>(Body::terms);
  auto* values =
      static_cast<double*>(context.workspace(static_cast<std::size_t>(n) * count * sizeof(double)));
  launch(context, "largest", n, StoreTerms<Body>{body, n, values});
  Terms<Body::terms> result;
  for (std::size_t k = 0; k < count; ++k)
    result.value[k] = maximum(context, {values + k * static_cast<std::size_t>(n), n}, TakeLargest::start);
  if (n.halo) ranks().take_largest(result.value, count);
  return result;
}

template <class Reduction, class Body, class Finish>
void launch_reduction(Context& context, const char*, Rows n, const Body& body, const Finish& finish) {
  if (!is_idle(body)) finish(reduce(Reduction{}, context, n, body));
}

#endif

}  // namespace slagflow
