// Sort, scan and reduce on device data: CUB in a CUDA build, Thrust in a CPU build.
#pragma once

#include <cstdint>

#include "backend/context.hpp"
#include "backend/rows.hpp"
#include "backend/span.hpp"

namespace slagflow {

#if defined(SLAGFLOW_CUDA)
inline constexpr bool sort_needs_scratch = true;
#else
inline constexpr bool sort_needs_scratch = false;
#endif

// Sorts the keys in ascending order and the values along with them; equal keys keep their order.
// Only the lowest `bits` bits of the keys are compared. The result is in `keys` and `values`; the scratch is
// of the same size where the back end needs any.
struct SortScratch {
  Span<std::uint64_t> keys;
  Span<Index> values;
};
void sort_by_key(Context&, Span<std::uint64_t> keys, Span<Index> values, SortScratch scratch, int bits);

// result[0] = 0, result[i+1] = result[i] + counts[i]; result has one element more than counts.
void exclusive_scan(Context&, Span<const Offset> counts, Span<Offset> result);

// Sum in the order of reduce.hpp, of the first values, as many as there are rows, in their planes; without
// rows of all, in none. Waits for the result.
double sum(Context&, Span<const double> values, Rows);
double sum(Context&, Span<const double> values);

// Largest value, or `floor` when there is none larger. A not-a-number yields not-a-number.
double maximum(Context&, Span<const double> values, double floor);

}  // namespace slagflow
