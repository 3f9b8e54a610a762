// What the program runs on.
#pragma once

#include <cstdint>
#include <string>

namespace slagflow {

struct DeviceInfo {
  std::string backend;  // "cpu" or "cuda"
  std::string name;     // processor or GPU
  int threads = 1;      // OpenMP threads of a CPU build
  double memory = 0;    // [bytes] that a GPU has free; 0: the host's memory is used
};

// What the host has asked of the device. A CPU build launches nothing, and its copies to the host count as
// waits.
struct DeviceCounts {
  std::int64_t waits = 0;           // of the host for the device
  std::int64_t launches = 0;        // of kernels, one by one
  std::int64_t graph_launches = 0;  // of graphs, and the kernels in them
  std::int64_t graph_kernels = 0;
  std::int64_t graph_recordings = 0;
  std::int64_t allocations = 0;  // of memory
};

// What a device lacks to repeat launches on its own, by the CUDA versions of the toolkit and the driver as
// CUDA numbers them (12040 is 12.4); empty: nothing.
inline std::string missing_for_loops(int toolkit, int driver) {
  constexpr int first = 12040;  // with conditional nodes that a kernel sets
  const auto name = [](int version) {
    return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
  };
  if (toolkit < first) return "CUDA 12.4 or newer; this program was built with CUDA " + name(toolkit);
  if (driver < first) return "a driver for CUDA 12.4 or newer; this one is for CUDA " + name(driver);
  return {};
}
// The same of what is here. A CPU build lacks nothing.
std::string missing_for_loops();

// Throws Error when a CUDA build finds no usable GPU.
DeviceInfo device_info();

// Which of a machine's GPUs a rank takes, by its number among those of the machine; 0 where there are none.
// (The runtime counts those that CUDA_VISIBLE_DEVICES leaves.)
inline int device_of_rank(int local_rank, int devices) { return devices > 0 ? local_rank % devices : 0; }
// Takes it; before all else that asks the device. No effect in a CPU build. Throws Error when it cannot be
// had.
void use_device_of_rank(int local_rank);

// Sets the number of OpenMP threads of a CPU build; no effect on a GPU.
void set_threads(int count);

}  // namespace slagflow
