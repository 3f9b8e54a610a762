#include <thrust/execution_policy.h>
#include <thrust/reduce.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

#include <cmath>
#include <vector>

#include "backend/primitives.hpp"
#include "backend/reduce.hpp"

namespace slagflow {

void sort_by_key(Context&, Span<std::uint64_t> keys, Span<Index> values, SortScratch, int) {
  thrust::stable_sort_by_key(thrust::omp::par, keys.data, keys.data + keys.size, values.data);
}

void exclusive_scan(Context&, Span<const Offset> counts, Span<Offset> result) {
  result[0] = 0;
  thrust::inclusive_scan(thrust::omp::par, counts.data, counts.data + counts.size, result.data + 1);
}

namespace {

struct Keep {
  double* result;
  void operator()(const Terms<1>& all) const { *result = all.value[0]; }
};

}  // namespace

double sum(Context& context, Span<const double> values, Rows rows) {
  double result = 0;
  launch_reduction<AddUp>(context, "sum", rows, ValueTerm{values}, Keep{&result});
  return result;
}

double sum(Context& context, Span<const double> values) {
  return sum(context, values, static_cast<Index>(values.size));
}

// In chunks, for threads.
double maximum(Context&, Span<const double> values, double floor) {
  constexpr Offset chunk = 4096;
  const auto larger = [](double a, double b) { return std::isnan(a) || a > b ? a : b; };
  const Offset chunks = (values.size + chunk - 1) / chunk;
  std::vector<double> largest(static_cast<std::size_t>(chunks), floor);
#pragma omp parallel for schedule(static)
  for (Offset c = 0; c < chunks; ++c) {
    const double* first = values.data + c * chunk;
    const double* last = values.data + (values.size < (c + 1) * chunk ? values.size : (c + 1) * chunk);
    largest[static_cast<std::size_t>(c)] = thrust::reduce(thrust::seq, first, last, floor, larger);
  }
  return thrust::reduce(thrust::seq, largest.begin(), largest.end(), floor, larger);
}

}  // namespace slagflow
