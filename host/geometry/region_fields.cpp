#include "host/geometry/region_fields.hpp"

#include <cmath>

namespace slagflow {
namespace {

constexpr double two_pi = 6.283185307179586;

// One round of splitmix64 (Steele, Lea and Flood 2014): neighbouring numbers give unrelated bits.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

Vec3d initial_velocity(const RegionSpec& region, Vec3d p) {
  Vec3d v = region.velocity + cross(region.angular_velocity, p - region.center);
  for (const WaveSpec& wave : region.waves)
    v += std::sin(two_pi * dot(wave.wave_vector, p) + wave.phase) * wave.amplitude;
  return v;
}

Vec3d jitter_of(std::uint64_t number) {
  constexpr double bits = 9007199254740992.0;  // 2^53
  Vec3d offset;
  for (int k = 0; k < 3; ++k)
    offset[k] = 2 * static_cast<double>(mixed(3 * number + static_cast<std::uint64_t>(k)) >> 11) / bits - 1;
  return offset;
}

}  // namespace slagflow
