#include "backend/slabs.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "backend/error.hpp"

namespace slagflow {

// On a ring of two the other slab is above and below at once.
Slabs::Slabs(int planes, bool periodic, int ranks)
    : planes_(planes), least_(periodic && ranks == 2 ? 2 * halo_planes : halo_planes), periodic_(periodic) {
  if (ranks > 1 && planes < ranks * least_)
    throw InputError("the domain is " + std::to_string(planes) + " cells long, of which each of " +
                     std::to_string(ranks) + " ranks needs " + std::to_string(least_) + ": at most " +
                     std::to_string(std::max(1, planes / least_)) + " ranks can share it");
  for (int r = 0; r <= ranks; ++r)
    cuts_.push_back(static_cast<int>(static_cast<std::int64_t>(planes) * r / ranks));
}

Slab Slabs::of(int rank) const {
  Slab slab{first(rank), own(rank), 0, 0};
  if (ranks() == 1) return slab;
  if (above(rank) >= 0) slab.above = halo_planes;
  if (below(rank) >= 0) slab.below = halo_planes;
  return slab;
}

int Slabs::above(int rank) const {
  if (ranks() == 1) return -1;
  if (rank + 1 < ranks()) return rank + 1;
  return periodic_ ? 0 : -1;
}

int Slabs::below(int rank) const {
  if (ranks() == 1) return -1;
  if (rank > 0) return rank - 1;
  return periodic_ ? ranks() - 1 : -1;
}

double Slabs::heaviest_over_mean(const std::vector<std::int64_t>& weight) const {
  std::int64_t heaviest = 0, all = 0;
  for (int r = 0; r < ranks(); ++r) {
    const std::int64_t own =
        std::accumulate(weight.begin() + first(r), weight.begin() + first(r + 1), std::int64_t(0));
    heaviest = std::max(heaviest, own), all += own;
  }
  return all > 0 ? static_cast<double>(heaviest) * ranks() / static_cast<double>(all) : 1;
}

// Each where the sum of the weights below comes nearest to its share, with the least number of planes
// between.
void Slabs::cut(const std::vector<std::int64_t>& weight) {
  std::vector<std::int64_t> below(weight.size() + 1);
  std::partial_sum(weight.begin(), weight.end(), below.begin() + 1);
  const std::int64_t all = below.back();
  for (int r = 1; r < ranks(); ++r) {
    const std::int64_t share = all / ranks() * r + all % ranks() * r / ranks();
    const auto at = std::lower_bound(below.begin(), below.end(), share);
    auto plane = static_cast<int>(at - below.begin());
    if (plane > 0 && share - below[static_cast<std::size_t>(plane) - 1] < *at - share) --plane;
    const int low = first(r - 1) + least(), high = planes_ - (ranks() - r) * least();
    cuts_[static_cast<std::size_t>(r)] = std::clamp(plane, low, high);
  }
}

bool Slabs::balance(const std::vector<std::int64_t>& weight) {
  constexpr double allowed = 1.1;
  const double now = heaviest_over_mean(weight);
  if (ranks() == 1 || now <= allowed) return false;
  Slabs other = *this;
  other.cut(weight);
  if (other.cuts_ == cuts_ || !(other.heaviest_over_mean(weight) < now)) return false;
  *this = other;
  return true;
}

void Slabs::shuffle(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (int r = 1; r < ranks(); ++r) {
    const int low = first(r - 1) + least(), high = planes_ - (ranks() - r) * least();
    cuts_[static_cast<std::size_t>(r)] = low + static_cast<int>(random() % (high - low + 1));
  }
}

}  // namespace slagflow
