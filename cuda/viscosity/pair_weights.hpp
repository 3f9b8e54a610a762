// The weights w_ij of the viscous pairs as they are stored, in full or in 16 bits.
#pragma once

#include <cstdint>
#include <cstring>

#include "backend/lanes.hpp"
#include "backend/span.hpp"
#include "fluid/setup.hpp"

namespace slagflow {

// The upper bits of a number in single precision that is below 2^-63: six of its exponent, ten of its
// mantissa, rounded to nearest. A weight is scaled to it by a power of two. Relative errors are up to 2^-11,
// random, and the same in both rows of a pair; over a row of neighbours 10^-4 of it. Of what is larger there
// is the largest, and the smallest fade out.
using ShortWeight = std::uint16_t;
inline constexpr int dropped_bits = 13;

HOST_DEVICE inline ShortWeight shorten(float scaled) {
  std::uint32_t all = 0;
  memcpy(&all, &scaled, sizeof all);
  all = (all + (1u << (dropped_bits - 1))) >> dropped_bits;
  return static_cast<ShortWeight>(all < 0xffffu ? all : 0xffffu);
}
HOST_DEVICE inline float lengthen(ShortWeight weight) {
  const std::uint32_t all = static_cast<std::uint32_t>(weight) << dropped_bits;
  float scaled = 0;
  memcpy(&scaled, &all, sizeof scaled);
  return scaled;
}

#if defined(SLAGFLOW_CUDA)
HOST_DEVICE inline Lanes lengthen(const ShortWeight* from) { return static_cast<Real>(lengthen(*from)); }
HOST_DEVICE inline void shorten(ShortWeight* to, Lanes scaled) { *to = shorten(static_cast<float>(scaled)); }
#else
HOST_DEVICE_INLINED Lanes lengthen(const ShortWeight* from) {
#if defined(__AVX2__)
  if constexpr (sizeof(Real) == 4) {
    const __m256i all = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
    return Lanes((Lanes::Vector)_mm256_slli_epi32(all, dropped_bits));
  }
#endif
  Lanes result;
  for (int k = 0; k < lane_count; ++k) result.v[k] = static_cast<Real>(lengthen(from[k]));
  return result;
}
HOST_DEVICE_INLINED void shorten(ShortWeight* to, Lanes scaled) {
#if defined(__AVX2__)
  if constexpr (sizeof(Real) == 4) {
    const __m256i half = _mm256_set1_epi32(1 << (dropped_bits - 1)), most = _mm256_set1_epi32(0xffff);
    const __m256i all = _mm256_srli_epi32(_mm256_add_epi32((__m256i)scaled.v, half), dropped_bits);
    const __m256i kept = _mm256_min_epu32(all, most);
    const __m128i both = _mm_packus_epi32(_mm256_castsi256_si128(kept), _mm256_extracti128_si256(kept, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), both);
    return;
  }
#endif
  for (int k = 0; k < lane_count; ++k) to[k] = shorten(static_cast<float>(scaled.v[k]));
}
#endif

struct FullWeights {
  const Real* weight;
  HOST_DEVICE_INLINED Lanes load(Offset at) const { return load_lanes(weight + at); }
  HOST_DEVICE_INLINED void foresee(Offset at) const { slagflow::foresee(weight + at); }
};
struct BriefWeights {
  const ShortWeight* weight;
  Real unit;
  HOST_DEVICE_INLINED Lanes load(Offset at) const { return unit * lengthen(weight + at); }
  HOST_DEVICE_INLINED void foresee(Offset at) const { slagflow::foresee(weight + at); }
};

// What a solver reads, laid out as the fluid list. Of one of the two there is none.
struct PairWeights {
  Span<const Real> full;  // [kg/m^2]
  Span<const ShortWeight> brief;
  Real unit = 1;  // [kg/m^2] of `brief`

  PairWeights() = default;
  HOST_DEVICE PairWeights(Span<const Real> weights) : full(weights) {}
  HOST_DEVICE PairWeights(Span<const ShortWeight> weights, double one)
      : brief(weights), unit(static_cast<Real>(one)) {}

  // From `at` on, lane_count of them.
  HOST_DEVICE_INLINED Lanes load(Offset at) const {
    return brief.data ? unit * lengthen(brief.data + at) : load_lanes(full.data + at);
  }
  HOST_DEVICE Real one(Offset at) const {
    return brief.data ? unit * static_cast<Real>(lengthen(brief[at])) : full[at];
  }
  HOST_DEVICE_INLINED void foresee(Offset at) const {
    brief.data ? slagflow::foresee(brief.data + at) : slagflow::foresee(full.data + at);
  }
};

// What an assembly writes.
struct PairWeightsToWrite {
  Span<Real> full;
  Span<ShortWeight> brief;
  Real scale = 1;  // one over the unit

  PairWeightsToWrite(Span<Real> weights) : full(weights) {}
  PairWeightsToWrite(Span<ShortWeight> weights, double unit)
      : brief(weights), scale(static_cast<Real>(1 / unit)) {}

  HOST_DEVICE_INLINED void store(Offset at, Lanes weight) const {
    brief.data ? shorten(brief.data + at, scale * weight) : store_lanes(full.data + at, weight);
  }
};

// A weight [kg/m^2] in the middle of those of a run: of fluid at a shear rate of 1/s, the geometric mean of
// the thinnest and the thickest.
double middle_weight(const SimulationSetup&);
// The unit of short weights for it, a power of two: 2^29 times as thin and 2^33 times as thick fluids have
// theirs to ten bits.
double short_weight_unit(double middle);

}  // namespace slagflow
