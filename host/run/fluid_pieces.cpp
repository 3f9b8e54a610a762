// Which fluid of the start touches, and how thick it is.
#include <algorithm>
#include <array>
#include <cmath>

#include "backend/host_loop.hpp"
#include "host/geometry/paged.hpp"
#include "host/run/start_facts.hpp"

namespace slagflow {
namespace {

using Site = std::array<std::int64_t, 3>;
using Word = std::uint64_t;

constexpr std::int64_t width = 64;        // sites of a word
constexpr std::size_t at_once = 1 << 15;  // particles that a thread looks at

// The particles of the start by their sites, those of the domain and around it. A place is a site's number:
// rows along x begin with a word of their own.
class Sites {
 public:
  static constexpr std::int64_t nowhere = -1;

  Sites(const SimulationSetup& setup, Vec3d origin)
      : setup_(setup),
        origin_(origin),
        first_(first_site()),
        count_(site_count()),
        place_(places()),
        particle_(size(), none),
        left_(size() / static_cast<std::size_t>(width), 0) {
    for (std::size_t i = 0; i < place_.size(); ++i) {
      if (place_[i] == nowhere || particle_[at(place_[i])] != none) continue;
      particle_.set(at(place_[i]), static_cast<std::int32_t>(i));
      left_[at(place_[i] / width)] |= Word{1} << (place_[i] % width);
    }
  }

  std::size_t count() const { return place_.size(); }

  // All that hangs together with a particle, which no piece has had; their places, in the order found.
  void take_piece(std::size_t first, std::vector<std::int64_t>& piece) {
    piece.assign(1, place_[first]);
    if (place_[first] == nowhere) return;
    if (has_site(first)) left_[at(place_[first] / width)] &= ~(Word{1} << (place_[first] % width));
    for (std::size_t next = 0; next < piece.size(); ++next)
      for (std::int64_t k = 0; k < 9; ++k)
        take_three(piece[next] + (k % 3 - 1) * along(1) + (k / 3 - 1) * along(2) - 1, piece);
  }
  bool taken(std::size_t i) const {
    return has_site(i) && (left_[at(place_[i] / width)] >> (place_[i] % width) & 1) == 0;
  }
  std::size_t particle(std::int64_t place) const { return at(particle_[at(place)]); }

  // Particles of the same fluid in the shortest row through one along an axis.
  double across(std::size_t i) const {
    std::int64_t least = longest;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(axis == 1 && setup_.dimensions == 2)) least = std::min(least, row(i, axis));
    return static_cast<double>(least);
  }

 private:
  static constexpr std::int64_t longest = 100;
  static constexpr std::int32_t none = -1;

  static std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }
  std::size_t size() const { return at(along(2) * count_[2]); }
  // From a place to the next along an axis.
  std::int64_t along(std::size_t axis) const {
    const std::int64_t row = (count_[0] + width - 1) / width * width;
    return axis == 0 ? 1 : axis == 1 ? row : row * count_[1];
  }
  double site(Vec3d p, int axis) const { return (p[axis] - origin_[axis]) / setup_.spacing - 0.5; }

  // With one more on each side of the domain, and one more around those, which are empty.
  Site first_site() const {
    Site first{};
    for (int k = 0; k < 3; ++k) first[at(k)] = std::llround(site(setup_.domain.lower, k)) - 2;
    return first;
  }
  Site site_count() const {
    Site count{};
    for (int k = 0; k < 3; ++k) count[at(k)] = std::llround(site(setup_.domain.upper, k)) + 3 - first_[at(k)];
    return count;
  }

  std::vector<std::int64_t> places() const {
    const std::vector<Vec3d>& all = setup_.particles.position;
    std::vector<std::int64_t> places(all.size(), nowhere);
    for_each_range(all.size(), at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        std::int64_t place = 0;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int64_t s = std::llround(site(all[i], static_cast<int>(k)));
          inside = inside && s > first_[k] && s < first_[k] + count_[k] - 1;
          if (inside) place += along(k) * (s - first_[k]);
        }
        if (inside) places[i] = place;
      }
    });
    return places;
  }

  // Of particles at one site the first has it.
  bool has_site(std::size_t i) const {
    return place_[i] != nowhere && particle_[at(place_[i])] == static_cast<std::int32_t>(i);
  }
  int kind(std::size_t i) const { return i < setup_.particles.fluid.size() ? setup_.particles.fluid[i] : 0; }

  // What is left of three places in a row.
  void take_three(std::int64_t place, std::vector<std::int64_t>& piece) {
    const std::int64_t from = place % width;
    Word* const word = &left_[at(place / width)];
    Word three = *word >> from & 7;
    if (from > width - 3) three |= word[1] << (width - from) & 7;
    for (std::int64_t k = 0; three >> k != 0; ++k) {
      if ((three >> k & 1) == 0) continue;
      piece.push_back(place + k);
      left_[at((place + k) / width)] &= ~(Word{1} << ((place + k) % width));
    }
  }

  std::int64_t row(std::size_t i, std::size_t axis) const {
    if (place_[i] == nowhere) return 1;
    const std::int64_t rest = axis == 2 ? place_[i] : place_[i] % along(axis + 1);
    const std::int64_t here = rest / along(axis);
    std::int64_t count = 1;
    for (const std::int64_t way : {-1, 1})
      for (std::int64_t step = 1; step < longest; ++step) {
        const std::int64_t there = here + way * step;
        if (there < 0 || there >= count_[axis]) break;
        const std::int32_t other = particle_[at(place_[i] + way * step * along(axis))];
        if (other == none || kind(at(other)) != kind(i)) break;
        ++count;
      }
    return count;
  }

  const SimulationSetup& setup_;
  Vec3d origin_;
  Site first_, count_;
  std::vector<std::int64_t> place_;  // of each particle
  Paged<std::int32_t> particle_;     // of each place
  std::vector<Word> left_;           // a bit for each place whose particle is in no piece yet
};

// Of a sample where there are many.
double median_across(const Sites& sites, std::size_t first, const std::vector<std::int64_t>& piece) {
  constexpr std::size_t looked_at = 2000;
  std::vector<double> across{sites.across(first)};
  const std::size_t stride = std::max<std::size_t>(1, piece.size() / looked_at);
  for (std::size_t k = stride; k < piece.size(); k += stride)
    across.push_back(sites.across(sites.particle(piece[k])));
  const auto middle = across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2);
  std::nth_element(across.begin(), middle, across.end());
  return *middle;
}

}  // namespace

std::vector<FluidPiece> fluid_pieces(const SimulationSetup& setup, Vec3d origin) {
  Sites sites(setup, origin);
  std::vector<FluidPiece> pieces;
  std::vector<std::int64_t> piece;
  for (std::size_t i = 0; i < sites.count(); ++i) {
    if (sites.taken(i)) continue;
    sites.take_piece(i, piece);
    pieces.push_back({piece.size(), setup.particles.position[i], median_across(sites, i, piece)});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const FluidPiece& a, const FluidPiece& b) { return a.particles > b.particles; });
  return pieces;
}

}  // namespace slagflow
