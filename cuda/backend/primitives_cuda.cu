#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include "backend/check.hpp"
#include "backend/reduce.hpp"

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

namespace {

struct Keep {
  double* result;
  HOST_DEVICE void operator()(const Terms<1>& all) const { *result = all.value[0]; }
};

template <class Reduction>
double reduced(Context& context, Span<const double> values, Rows rows) {
  auto* result = reinterpret_cast<double*>(static_cast<char*>(context.ticket()) + Context::result_at);
  launch_reduction<Reduction>(context, "reduction", rows, ValueTerm{values}, Keep{result});
  double host = 0;
  context.copy_to_host(&host, result, sizeof host);
  return host;
}

double above(double floor, double largest) { return largest < floor ? floor : largest; }

}  // namespace

double sum(Context& context, Span<const double> values, Rows rows) {
  return reduced<AddUp>(context, values, rows);
}

double sum(Context& context, Span<const double> values) {
  return sum(context, values, static_cast<Index>(values.size));
}

double maximum(Context& context, Span<const double> values, double floor) {
  return above(floor, reduced<TakeLargest>(context, values, static_cast<Index>(values.size)));
}

}  // namespace slagflow
