// What the program runs on.
#pragma once

#include <string>

namespace slagflow {

struct DeviceInfo {
  std::string backend;  // "cpu" or "cuda"
  std::string name;     // processor or GPU
  int threads = 1;      // OpenMP threads of a CPU build
  double memory = 0;    // [bytes] that a GPU has free; 0: the host's memory is used
};

// Throws Error when a CUDA build finds no usable GPU.
DeviceInfo device_info();

// Sets the number of OpenMP threads of a CPU build; no effect on a GPU.
void set_threads(int count);

}  // namespace slagflow
