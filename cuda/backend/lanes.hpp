// Several pairs at once: `Lanes` holds one number for each of lane_count pairs in a vector register of a CPU.
// A GPU has a thread for each particle and takes the pairs one by one: one lane, and Lanes is Real. Bodies
// are written for either. The vector types are those of GCC and Clang, on any instruction set; AVX
// gets a shorter way of gathering, AVX2 and AVX-512 get shorter ways of appending.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "backend/platform.hpp"

#if !defined(SLAGFLOW_CUDA) && defined(__AVX__)
#include <immintrin.h>
#endif

namespace slagflow {

// The same operations on a single number.
HOST_DEVICE inline Real select(bool mask, Real a, Real b) { return mask ? a : b; }
HOST_DEVICE inline Real root(Real a) { return std::sqrt(a); }
HOST_DEVICE inline Real nearest_integer(Real a) { return std::rint(a); }
HOST_DEVICE inline Real magnitude(Real a) { return std::fabs(a); }
HOST_DEVICE inline unsigned bits(bool mask) { return mask ? 1 : 0; }

#if defined(SLAGFLOW_CUDA)

inline constexpr int lane_count = 1;
using Lanes = Real;
using LaneMask = bool;

HOST_DEVICE inline Index number_of(unsigned lanes) { return static_cast<Index>(lanes); }
HOST_DEVICE inline Real total(Real a) { return a; }
HOST_DEVICE inline Real least(Real a) { return a; }
HOST_DEVICE inline bool first_lanes(Index n) { return n > 0; }
HOST_DEVICE inline void foresee(const void*) {}
HOST_DEVICE inline Real load_lanes(const Real* from) { return *from; }
HOST_DEVICE inline void store_lanes(Real* to, Real a) { *to = a; }
// Numbers of elements, one a lane.
struct Entries {
  Index number;
  HOST_DEVICE Index operator[](int) const { return number; }
};
HOST_DEVICE inline Real gather(const Real* from, const Entries& at) { return from[at.number]; }
template <class Block>
HOST_DEVICE void gather(const Block* from, const Entries& at, Real (&parts)[4]) {
  const Block block = from[at.number];
  parts[0] = block.x, parts[1] = block.y, parts[2] = block.z, parts[3] = block.w;
}
template <int stride>
HOST_DEVICE Index* append(Index* to, const Index*, Index value, unsigned lanes) {
  if (lanes) *to = value;
  return lanes ? to + stride : to;
}
inline Index* append(Index* to, const Index* values, unsigned lanes) {
  if (lanes) *to = *values;
  return lanes ? to + 1 : to;
}
inline void append(Real* to, Real value, unsigned lanes) {
  if (lanes) *to = value;
}

#else

#if defined(__AVX__)
inline constexpr int lane_bytes = 32;
#else
inline constexpr int lane_bytes = 16;
#endif
inline constexpr int lane_count = lane_bytes / static_cast<int>(sizeof(Real));

struct LaneMask {
  using Integer = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  using Vector __attribute__((vector_size(lane_bytes))) = Integer;
  Vector v;
  friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
};

struct Lanes {
  using Vector __attribute__((vector_size(lane_bytes))) = Real;
  Vector v{};

  Lanes() = default;
  Lanes(Real a) : v(a - Vector{}) {}
  explicit Lanes(Vector a) : v(a) {}

  Lanes& operator+=(Lanes b) { return v += b.v, *this; }
  Lanes& operator-=(Lanes b) { return v -= b.v, *this; }
  Lanes& operator*=(Lanes b) { return v *= b.v, *this; }
  friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
  friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
  friend LaneMask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  friend LaneMask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
};

// Lane by lane a where the mask holds, else b.
inline Lanes select(LaneMask mask, Lanes a, Lanes b) { return Lanes(mask.v ? a.v : b.v); }
inline Lanes magnitude(Lanes a) { return Lanes(a.v < 0 ? -a.v : a.v); }
inline Lanes smaller(Lanes a, Lanes b) { return Lanes(b.v < a.v ? b.v : a.v); }
inline Lanes larger(Lanes a, Lanes b) { return Lanes(a.v < b.v ? b.v : a.v); }

inline Lanes root(Lanes a) {
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 4)
    return Lanes((Lanes::Vector)_mm256_sqrt_ps((__m256)a.v));
  else
    return Lanes((Lanes::Vector)_mm256_sqrt_pd((__m256d)a.v));
#else
  for (int k = 0; k < lane_count; ++k) a.v[k] = std::sqrt(a.v[k]);
  return a;
#endif
}

inline Lanes nearest_integer(Lanes a) {
#if defined(__AVX__)
  constexpr int mode = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
  if constexpr (sizeof(Real) == 4)
    return Lanes((Lanes::Vector)_mm256_round_ps((__m256)a.v, mode));
  else
    return Lanes((Lanes::Vector)_mm256_round_pd((__m256d)a.v, mode));
#else
  for (int k = 0; k < lane_count; ++k) a.v[k] = std::rint(a.v[k]);
  return a;
#endif
}

// A bit for each lane in which the mask holds; lane 0 is the lowest.
inline unsigned bits(LaneMask mask) {
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 4)
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask.v));
  else
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask.v));
#else
  unsigned result = 0;
  for (int k = 0; k < lane_count; ++k) result |= (mask.v[k] ? 1u : 0u) << k;
  return result;
#endif
}

inline Index number_of(unsigned lanes) { return __builtin_popcount(lanes); }

// Sum over the lanes, always in the same order: of halves, as a tree.
inline Real total(Lanes a) {
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 4) {
    const __m128 half =
        _mm_add_ps(_mm256_castps256_ps128((__m256)a.v), _mm256_extractf128_ps((__m256)a.v, 1));
    const __m128 quarter = _mm_add_ps(half, _mm_movehl_ps(half, half));
    return _mm_cvtss_f32(_mm_add_ss(quarter, _mm_shuffle_ps(quarter, quarter, 1)));
  }
#endif
  for (int half = lane_count / 2; half > 0; half /= 2)
    for (int k = 0; k < half; ++k) a.v[k] += a.v[k + half];
  return a.v[0];
}

// The smallest of the lanes.
inline Real least(Lanes a) {
  Real result = a.v[0];
  for (int k = 1; k < lane_count; ++k) result = a.v[k] < result ? a.v[k] : result;
  return result;
}

// Holds in the lanes below n.
inline LaneMask first_lanes(Index n) {
  LaneMask::Vector number;
  for (int k = 0; k < lane_count; ++k) number[k] = k;
  return {number < static_cast<LaneMask::Integer>(n)};
}

// Fetches what lies a few rows of a list ahead in a stream that is read once: what the hardware foresees ends
// with its pages. A kibibyte was best of half, one and two.
HOST_DEVICE_INLINED void foresee(const void* at) { __builtin_prefetch(static_cast<const char*>(at) + 1024); }

inline Lanes load_lanes(const Real* from) {
  Lanes a;
  __builtin_memcpy(&a.v, from, sizeof a.v);
  return a;
}
inline void store_lanes(Real* to, Lanes a) { __builtin_memcpy(to, &a.v, sizeof a.v); }

// Numbers of elements, one a lane.
struct Entries {
  const Index* number;
  HOST_DEVICE_INLINED Index operator[](int k) const { return number[k]; }
};

// Element at[k] in lane k.
inline Lanes gather(const Real* from, const Entries& at) {
  Lanes a;
  for (int k = 0; k < lane_count; ++k) a.v[k] = from[at[k]];
  return a;
}

// The numbers x, y, z, w of element at[k] in lane k of the four parts.
template <class Block>
HOST_DEVICE_INLINED void gather(const Block* from, const Entries& at, Lanes (&parts)[4]) {
#if defined(__AVX__)
  if constexpr (sizeof(Real) == 4) {
    // 128 bits each, in pairs, then transposed: half the work of the gather instruction.
    static_assert(sizeof(Block) == 4 * sizeof(Real) && alignof(Block) == sizeof(Block));
    const auto* block = reinterpret_cast<const __m128*>(from);
    const auto pair = [&](int k) {
      return _mm256_insertf128_ps(_mm256_castps128_ps256(block[at[k]]), block[at[k + 4]], 1);
    };
    const __m256 a = pair(0), b = pair(1), c = pair(2), d = pair(3);
    const __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
    const __m256 ab_high = _mm256_unpackhi_ps(a, b), cd_high = _mm256_unpackhi_ps(c, d);
    parts[0].v = (Lanes::Vector)_mm256_shuffle_ps(ab, cd, 0x44);
    parts[1].v = (Lanes::Vector)_mm256_shuffle_ps(ab, cd, 0xee);
    parts[2].v = (Lanes::Vector)_mm256_shuffle_ps(ab_high, cd_high, 0x44);
    parts[3].v = (Lanes::Vector)_mm256_shuffle_ps(ab_high, cd_high, 0xee);
    return;
  }
#endif
  Real values[4][lane_count];
  for (int k = 0; k < lane_count; ++k) {
    const Block block = from[at[k]];
    values[0][k] = block.x, values[1][k] = block.y, values[2][k] = block.z, values[3][k] = block.w;
  }
  for (int part = 0; part < 4; ++part) parts[part] = load_lanes(values[part]);
}

#if defined(__AVX2__)
#if !defined(__AVX512VL__)
// For each set of lanes their numbers, from the lowest on, a byte each.
struct LaneOrder {
  std::uint64_t of[256] = {};
  constexpr LaneOrder() {
    for (unsigned lanes = 0; lanes < 256; ++lanes) {
      int place = 0;
      for (unsigned lane = 0; lane < 8; ++lane)
        if (lanes >> lane & 1) of[lanes] |= static_cast<std::uint64_t>(lane) << 8 * place++;
    }
  }
};
inline constexpr LaneOrder lane_order;
#endif

// The values of the lanes that are set, next to each other.
inline __m256i packed(__m256i values, unsigned lanes) {
#if defined(__AVX512VL__)
  return _mm256_maskz_compress_epi32(static_cast<__mmask8>(lanes), values);
#else
  const __m128i order = _mm_cvtsi64_si128(static_cast<long long>(lane_order.of[lanes]));
  return _mm256_permutevar8x32_epi32(values, _mm256_cvtepu8_epi32(order));
#endif
}
inline void store(void* to, __m256i values) { _mm256_storeu_si256(static_cast<__m256i*>(to), values); }
#endif

// Writes value + k for each lane k that is set; returns the place after the last. Nothing is written from
// `end` on.
template <int stride>
inline Index* append(Index* to, const Index* end, Index value, unsigned lanes) {
  static_assert(stride == 1);
#if defined(__AVX2__)
  if (to + 8 <= end) {
    const __m256i numbers =
        _mm256_add_epi32(_mm256_set1_epi32(value), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    store(to, packed(numbers, lanes));
    return to + number_of(lanes);
  }
#endif
  for (; lanes && to < end; lanes &= lanes - 1) *to++ = value + __builtin_ctz(lanes);
  return to;
}

// The same for values[k], with room for lane_count numbers at `to`.
inline Index* append(Index* to, const Index* values, unsigned lanes) {
#if defined(__AVX2__)
  if constexpr (lane_count == 8) {
    store(to, packed(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(values)), lanes));
    return to + number_of(lanes);
  }
#endif
  for (; lanes; lanes &= lanes - 1) *to++ = values[__builtin_ctz(lanes)];
  return to;
}
inline void append(Real* to, Lanes values, unsigned lanes) {
#if defined(__AVX2__)
  if constexpr (sizeof(Real) == 4) {
    store(to, packed((__m256i)values.v, lanes));
    return;
  }
#endif
  for (; lanes; lanes &= lanes - 1) *to++ = values.v[__builtin_ctz(lanes)];
}

#endif

}  // namespace slagflow
