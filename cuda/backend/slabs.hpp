// How the cells of a grid are dealt out to ranks: slabs of whole planes across the slowest axis, and the
// planes around each that it must know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "backend/platform.hpp"
#include "backend/ranks.hpp"

namespace slagflow {

// Lists are renewed from cells two away (neighbours/search.hpp).
inline constexpr int halo_planes = 2;

// The planes of a rank as it numbers them: its own first, then those above, then those below.
struct Slab {
  int first = 0;  // of its own, in the whole grid
  int own = 0, above = 0, below = 0;
  HOST_DEVICE int planes() const { return own + above + below; }
};

class Slabs {
 public:
  // Of so many planes; throws Error where they are too few for the ranks.
  Slabs(int planes, bool periodic, int ranks);

  // Deals the planes out so that the weights in each slab are about the same; true when that changes any cut.
  // They stay while the heaviest slab has no more than a tenth above the mean.
  bool balance(const std::vector<std::int64_t>& weight_of_plane);
  // At random, with room for the halos: cuts must not show in any result.
  void shuffle(std::uint64_t seed);

  int planes() const { return planes_; }
  int ranks() const { return static_cast<int>(cuts_.size()) - 1; }
  const std::vector<int>& cuts() const { return cuts_; }  // the first plane of each rank, then the end
  int first(int rank) const { return cuts_[static_cast<std::size_t>(rank)]; }
  int own(int rank) const { return cuts_[static_cast<std::size_t>(rank) + 1] - first(rank); }
  Slab of(int rank) const;
  int above(int rank) const;  // the rank there, -1: none
  int below(int rank) const;

 private:
  int least() const { return least_; }
  double heaviest_over_mean(const std::vector<std::int64_t>&) const;
  void cut(const std::vector<std::int64_t>&);

  int planes_, least_;  // in all, and of a slab
  bool periodic_;
  std::vector<int> cuts_;
};

}  // namespace slagflow
