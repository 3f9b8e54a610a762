// Every CUDA call and launch goes through here. Included by CUDA sources of the back end only.
#pragma once

#include <cuda_runtime.h>

#include <string>

#include "backend/error.hpp"

namespace slagflow {

inline void check(cudaError_t status, const char* what) {
  if (status != cudaSuccess)
    throw LocalError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status) + " (" +
                     cudaGetErrorName(status) + ")");
}

}  // namespace slagflow
