// What every file may assume of the machine: number types and the host/device marker.
#pragma once

#include <cstdint>

#if defined(__CUDACC__)
#define HOST_DEVICE __host__ __device__
#define HOST_DEVICE_INLINED __host__ __device__ __forceinline__
#else
#define HOST_DEVICE
#define HOST_DEVICE_INLINED inline __attribute__((always_inline))
#endif

#ifndef SLAGFLOW_REAL
#define SLAGFLOW_REAL float
#endif

namespace slagflow {

using Real = SLAGFLOW_REAL;   // working precision of everything but positions, times and sums
using Index = std::int32_t;   // particle numbers
using Offset = std::int64_t;  // positions in pair lists, which outgrow 32 bits

}  // namespace slagflow
