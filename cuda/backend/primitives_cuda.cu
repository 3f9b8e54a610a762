#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_reduce.cuh>
#include <cub/device/device_scan.cuh>

#include "backend/check.hpp"
#include "backend/primitives.hpp"

namespace slagflow {

namespace {

// CUB's two calls: how much scratch, then the work with the context's kept workspace. The last
// 16 bytes of the workspace hold a result.
template <class Call>
void* with_workspace(Context& context, const char* what, Call call) {
  std::size_t bytes = 0;
  check(call(nullptr, bytes, static_cast<void*>(nullptr)), what);
  const std::size_t rounded = (bytes + 255) / 256 * 256;
  char* memory = static_cast<char*>(context.workspace(rounded + 16));
  void* result = memory + rounded;
  check(call(memory, bytes, result), what);
  return result;
}

struct Larger {
  __host__ __device__ double operator()(double a, double b) const { return a != a || a > b ? a : b; }
};

}  // namespace

void sort_by_key(Context& context, Span<std::uint64_t> keys, Span<Index> values, SortScratch scratch,
                 int bits) {
  auto* stream = static_cast<cudaStream_t>(context.stream());
  cub::DoubleBuffer<std::uint64_t> key_buffer(keys.data, scratch.keys.data);
  cub::DoubleBuffer<Index> value_buffer(values.data, scratch.values.data);
  with_workspace(context, "radix sort", [&](void* memory, std::size_t& bytes, void*) {
    return cub::DeviceRadixSort::SortPairs(memory, bytes, key_buffer, value_buffer, keys.size, 0, bits,
                                           stream);
  });
  const auto count = static_cast<std::size_t>(keys.size);
  if (key_buffer.Current() != keys.data)
    context.copy_on_device(keys.data, key_buffer.Current(), count * sizeof(std::uint64_t));
  if (value_buffer.Current() != values.data)
    context.copy_on_device(values.data, value_buffer.Current(), count * sizeof(Index));
}

void exclusive_scan(Context& context, Span<const Offset> counts, Span<Offset> result) {
  auto* stream = static_cast<cudaStream_t>(context.stream());
  check(cudaMemsetAsync(result.data, 0, sizeof(Offset), stream), "clear");
  if (counts.size == 0) return;
  with_workspace(context, "scan", [&](void* memory, std::size_t& bytes, void*) {
    return cub::DeviceScan::InclusiveSum(memory, bytes, counts.data, result.data + 1, counts.size, stream);
  });
}

double sum(Context& context, Span<const double> values) {
  auto* stream = static_cast<cudaStream_t>(context.stream());
  void* result = with_workspace(context, "sum", [&](void* memory, std::size_t& bytes, void* out) {
    return cub::DeviceReduce::Sum(memory, bytes, values.data, static_cast<double*>(out), values.size, stream);
  });
  double host = 0;
  context.copy_to_host(&host, result, sizeof host);
  return host;
}

double maximum(Context& context, Span<const Real> values, double floor) {
  auto* stream = static_cast<cudaStream_t>(context.stream());
  void* result = with_workspace(context, "maximum", [&](void* memory, std::size_t& bytes, void* out) {
    return cub::DeviceReduce::Reduce(memory, bytes, values.data, static_cast<double*>(out), values.size,
                                     Larger{}, floor, stream);
  });
  double host = 0;
  context.copy_to_host(&host, result, sizeof host);
  return host;
}

}  // namespace slagflow
