#include <thrust/execution_policy.h>
#include <thrust/reduce.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

#include <cmath>
#include <vector>

#include "backend/primitives.hpp"

namespace slagflow {

void sort_by_key(Context&, Span<std::uint64_t> keys, Span<Index> values, SortScratch, int) {
  thrust::stable_sort_by_key(thrust::omp::par, keys.data, keys.data + keys.size, values.data);
}

void exclusive_scan(Context&, Span<const Offset> counts, Span<Offset> result) {
  result[0] = 0;
  thrust::inclusive_scan(thrust::omp::par, counts.data, counts.data + counts.size, result.data + 1);
}

namespace {

// Chunks of fixed length make the order of summation independent of the threads.
template <class Combine>
double reduce_in_chunks(Span<const double> values, double start, Combine combine) {
  constexpr Offset chunk = 4096;
  const Offset chunks = (values.size + chunk - 1) / chunk;
  std::vector<double> partial(static_cast<std::size_t>(chunks), start);
#pragma omp parallel for schedule(static)
  for (Offset c = 0; c < chunks; ++c) {
    const double* first = values.data + c * chunk;
    const double* last = values.data + (values.size < (c + 1) * chunk ? values.size : (c + 1) * chunk);
    partial[static_cast<std::size_t>(c)] = thrust::reduce(thrust::seq, first, last, start, combine);
  }
  return thrust::reduce(thrust::seq, partial.begin(), partial.end(), start, combine);
}

}  // namespace

double sum(Context&, Span<const double> values) {
  return reduce_in_chunks(values, 0.0, [](double a, double b) { return a + b; });
}

double maximum(Context&, Span<const double> values, double floor) {
  return reduce_in_chunks(values, floor, [](double a, double b) { return std::isnan(a) || a > b ? a : b; });
}

}  // namespace slagflow
