#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/geometry.hpp"

namespace slagflow {
namespace {

constexpr std::int64_t block = 8;      // sites along the edge of a block
constexpr double tie = 1e-6;           // [spacings] nudge that decides for sites on a face
constexpr double bytes_per_site = 6;   // more than the index of its wall, its bits and its pages take
constexpr double largest_index = 1e9;  // keeps positions exact to a fraction of a spacing

}  // namespace

std::string gigabytes(double bytes) {
  const double rounded = bytes < 1e15 ? std::round(bytes / 1e7) / 100 : bytes / 1e9;
  char text[40];
  std::snprintf(text, sizeof text, rounded < 1e6 ? "%.2f GB" : "%.2e GB", rounded);
  return text;
}

namespace {

std::string rounded(double count) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", count);
  return text;
}

// As std::llround, in line; of what is far off the same for all.
std::int64_t nearest(double x) {
  constexpr double far_off = 1e15;
  if (!(std::abs(x) < far_off)) return -1;
  const double whole = std::trunc(x), rest = x - whole;  // exact
  return static_cast<std::int64_t>(std::abs(rest) >= 0.5 ? whole + std::copysign(1.0, x) : whole);
}

// First site at or above a coordinate, counted from the origin.
double site_above(double coordinate, double origin, double spacing) {
  return std::ceil((coordinate - origin) / spacing - 0.5 - tie);
}

}  // namespace

double available_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key;
  for (double kilobytes = 0; meminfo >> key >> kilobytes; meminfo.ignore(100, '\n'))
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();  // not told: allocation will
}

Lattice::Lattice(const Case& c)
    : spacing_(c.spacing),
      origin_(c.origin),
      layers_(static_cast<std::int64_t>(std::ceil(c.support_ratio))),
      flat_(c.dimensions == 2),
      periodic_(c.domain.periodic),
      lower_(c.domain.lower),
      upper_(c.domain.upper) {
  double sites = 1;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (flat_ && k == 1) {
      count_[axis] = inner_last_[axis] = 1;
      continue;
    }
    const double first = site_above(c.domain.lower[k], c.origin[k], spacing_);
    const double last = site_above(c.domain.upper[k], c.origin[k], spacing_);
    if (!(std::abs(first) < largest_index && std::abs(last) < largest_index))
      throw InputError(c.place_of("resolution.spacing") + ": key 'resolution.spacing': value " +
                       show(spacing_) + ": the domain reaches more than 1e9 spacings from the origin: " +
                       "allowed: a larger spacing, a smaller domain, or a resolution.origin near it");
    const std::int64_t margin = periodic_[axis] ? 0 : layers_;
    first_[axis] = static_cast<std::int64_t>(first) - margin;
    count_[axis] = static_cast<std::int64_t>(last - first) + 2 * margin;
    inner_first_[axis] = margin;
    inner_last_[axis] = count_[axis] - margin;
    sites *= static_cast<double>(count_[axis]);
  }
  corner_ = position({0, 0, 0});
  const double available = available_memory();
  if (sites * bytes_per_site > available)
    throw InputError(c.place_of("resolution.spacing") + ": key 'resolution.spacing': the domain holds " +
                     rounded(sites) + " lattice sites and needs " + gigabytes(sites * bytes_per_site) +
                     " of memory, " + gigabytes(available) +
                     " are available: allowed: a larger spacing or a smaller domain");
}

Vec3d Lattice::position(const SiteIndex& s) const {
  Vec3d p;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    p[k] = origin_[k] + (static_cast<double>(first_[axis] + s[axis]) + 0.5) * spacing_;
  }
  if (flat_) p.y = 0;
  return p;
}

bool Lattice::in_domain(Vec3d p) const {
  for (int k = 0; k < 3; ++k)
    if (!(flat_ && k == 1) && !(p[k] >= lower_[k] && p[k] < upper_[k])) return false;
  return true;
}

std::optional<SiteIndex> Lattice::at(Vec3d place) const {
  const Vec3d from = wrapped(place) - corner_;
  SiteIndex s{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    if (count_[k] == 1 && !periodic(axis)) continue;  // the plane of two dimensions
    s[k] = nearest(from[axis] / spacing_);
    if (periodic(axis) && s[k] == count_[k]) s[k] = 0;
    if (s[k] < 0 || s[k] >= count_[k]) return {};
  }
  return s;
}

void Lattice::visit_inside(const Distance& distance, const Visit& visit) const {
  const VisitRow row = [&](const SiteIndex& first, std::int64_t count) {
    SiteIndex s = first;
    for (; s[0] < first[0] + count; ++s[0]) visit(s, position(s));
  };
  for (std::size_t part = 0; part < parts(); ++part) visit_part(part, distance, row);
}

std::size_t Lattice::parts() const {
  const auto blocks = [&](std::size_t axis) { return (count_[axis] + block - 1) / block; };
  return static_cast<std::size_t>(blocks(1) * blocks(2));
}

void Lattice::visit_part(std::size_t part, const Distance& distance, const VisitRow& visit) const {
  const std::int64_t blocks = (count_[1] + block - 1) / block, number = static_cast<std::int64_t>(part);
  SiteIndex first{0, block * (number % blocks), block * (number / blocks)};
  for (; first[0] < count_[0]; first[0] += block) visit_block(first, distance, visit);
}

void Lattice::visit_block(const SiteIndex& first, const Distance& distance, const VisitRow& visit) const {
  SiteIndex last{};
  for (std::size_t k = 0; k < 3; ++k) last[k] = std::min(first[k] + block, count_[k]) - 1;
  const Vec3d low = position(first), high = position(last);
  const double radius = 0.5 * norm(high - low) + 0.1 * spacing_;
  const double middle = distance(0.5 * (low + high));
  if (middle > radius) return;
  const double nudge = tie * spacing_;
  SiteIndex s = first;
  for (s[2] = first[2]; s[2] <= last[2]; ++s[2])
    for (s[1] = first[1]; s[1] <= last[1]; ++s[1]) {
      s[0] = first[0];
      if (middle < -radius) {
        visit(s, last[0] + 1 - first[0]);
        continue;
      }
      for (; s[0] <= last[0]; ++s[0]) {
        const Vec3d q = position(s) + nudge * Vec3d{1, flat_ ? 0 : tie_direction.y, tie_direction.z};
        if (distance(q) < 0) visit(s, 1);
      }
    }
}

Vec3d away_from(const Lattice::Distance& distance, Vec3d p, double step, bool flat) {
  Vec3d away;
  for (int k = 0; k < 3; ++k) {
    if (flat && k == 1) continue;
    Vec3d ahead = p, behind = p;
    ahead[k] += step, behind[k] -= step;
    away[k] = distance(ahead) - distance(behind);
  }
  return away;
}

}  // namespace slagflow
