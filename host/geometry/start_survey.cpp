#include "host/geometry/start_survey.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "backend/host_loop.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {
namespace {

constexpr std::int64_t near = 3;      // open sites between pieces that were to touch
constexpr std::int64_t thin = 3;      // particles across
constexpr std::size_t most_told = 4;  // pieces of a region whose shares are told

std::string place(Vec3d p) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) m", p.x, p.y, p.z);
  return text;
}

std::string percent(std::size_t part, std::size_t all) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * static_cast<double>(part) / static_cast<double>(all));
  return text;
}

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class StartSurvey {
 public:
  StartSurvey(const Case& c, const Filling& filling)
      : c_(c), filling_(filling), sites_(*filling.sites), piece_(filling.touching.of) {}

  void warn(std::vector<std::string>& warnings) const {
    for (std::size_t r = 0; r < c_.regions.size(); ++r) warn_of_pieces(r, warnings);
    warn_of_gap(warnings);
    warn_of_thinnest(warnings);
    for (std::size_t m = 0; m < c_.measures.size(); ++m) warn_of_arrived(m, warnings);
  }

 private:
  bool flat(int axis) const { return axis == 1 && c_.dimensions == 2; }

  void warn_of_pieces(std::size_t r, std::vector<std::string>& warnings) const {
    struct Part {
      std::size_t count = 0, first = 0;
    };
    std::map<std::int32_t, Part> parts;
    std::size_t all = 0;
    for (std::size_t i = 0; i < piece_.size(); ++i)
      if (filling_.region[i] == r) {
        Part& part = parts[piece_[i]];
        if (part.count++ == 0) part.first = i;
        ++all;
      }
    if (parts.size() <= std::max<std::size_t>(c_.regions[r].shapes.size(), 1)) return;
    std::vector<Part> sorted;
    for (const auto& [piece, part] : parts) sorted.push_back(part);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Part& a, const Part& b) { return a.count > b.count; });
    std::string shares;
    for (std::size_t k = 0; k < std::min(sorted.size(), most_told); ++k)
      shares += (k == 0 ? "" : ", ") + percent(sorted[k].count, all) + " at " +
                place(filling_.fluid.position[sorted[k].first]);
    warnings.push_back("region " + std::to_string(r) + " starts in " + std::to_string(parts.size()) +
                       " pieces that do not touch: " + shares + (sorted.size() > most_told ? ", ..." : "") +
                       "; walls or earlier regions part it. Is fluid behind a wall where none should be?");
  }

  // What is first met along an axis, and after how many open sites.
  struct Met {
    std::int32_t particle = StartSites::none;
    std::int64_t open = 0;
  };
  Met ahead(const SiteIndex& site, int axis) const {
    for (std::int64_t step = 1; step <= near + 1; ++step) {
      const auto beside = sites_.beside(site, axis, step);
      if (!beside || sites_.wall(*beside) != StartSites::none) return {};
      if (sites_.fluid(*beside) != StartSites::none) return {sites_.fluid(*beside), step - 1};
    }
    return {};
  }

  void warn_of_gap(std::vector<std::string>& warnings) const {
    for (std::size_t i = 0; filling_.touching.count > 1 && i < piece_.size(); ++i) {
      const SiteIndex site = sites_.index(sites_.taken()[i]);
      for (int axis = 0; axis < 3; ++axis) {
        const Met met = flat(axis) ? Met{} : ahead(site, axis);
        if (met.particle == StartSites::none || piece_[at(met.particle)] == piece_[i]) continue;
        const std::uint32_t one = filling_.region[i], other = filling_.region[at(met.particle)];
        warnings.push_back("fluid of region " + std::to_string(one) + " and of region " +
                           std::to_string(other) + " almost touches: " + std::to_string(met.open) +
                           " spacings of air along " + "xyz"[axis] + " lie between them at " +
                           place(filling_.fluid.position[i]) +
                           "; were they to touch? Then let their shapes share a face");
        return;
      }
    }
  }

  // Particles of the same fluid in a row with one, itself included, up to `thin`.
  std::int64_t across(std::size_t i, const SiteIndex& site, int axis) const {
    std::int64_t count = 1;
    for (const std::int64_t way : {-1, 1})
      for (std::int64_t step = 1; step < thin && count < thin; ++step) {
        const auto beside = sites_.beside(site, axis, way * step);
        const std::int32_t other = beside ? sites_.fluid(*beside) : StartSites::none;
        if (other == StartSites::none || filling_.fluid.fluid[at(other)] != filling_.fluid.fluid[i]) break;
        ++count;
      }
    return count;
  }

  using Counts = std::vector<std::array<std::size_t, thin + 1>>;  // of each region, by particles across

  Counts counts_across() const {
    constexpr std::size_t at_once = 1 << 15;
    std::vector<Counts> parts((piece_.size() + at_once - 1) / at_once, Counts(c_.regions.size()));
    for_each_range(piece_.size(), at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const SiteIndex site = sites_.index(sites_.taken()[i]);
        std::int64_t least = thin;
        for (int axis = 0; axis < 3; ++axis)
          if (!flat(axis)) least = std::min(least, across(i, site, axis));
        ++parts[first / at_once][filling_.region[i]][static_cast<std::size_t>(least)];
      }
    });
    Counts counts(c_.regions.size());
    for (const Counts& part : parts)
      for (std::size_t r = 0; r < counts.size(); ++r)
        for (std::size_t k = 0; k < counts[r].size(); ++k) counts[r][k] += part[r][k];
    return counts;
  }

  // By the median of a region's particles.
  void warn_of_thinnest(std::vector<std::string>& warnings) const {
    const Counts counts = counts_across();
    std::size_t thinnest = 0, layers = thin;
    for (std::size_t r = 0; r < counts.size(); ++r) {
      const std::size_t all = counts[r][1] + counts[r][2] + counts[r][3];
      const std::size_t here = 2 * counts[r][1] > all                    ? 1
                               : 2 * (counts[r][1] + counts[r][2]) > all ? 2
                                                                         : thin;
      if (here < layers) layers = here, thinnest = r;
    }
    if (layers >= thin) return;
    warnings.push_back("region " + std::to_string(thinnest) + " is " +
                       (layers == 1 ? std::string("1 particle") : "2 particles") +
                       " across over most of it: fluid as thin as that does not flow as it should; a "
                       "resolution.spacing of " +
                       show(c_.spacing * static_cast<double>(layers) / 4) + " m gives it four");
  }

  void warn_of_arrived(std::size_t m, std::vector<std::string>& warnings) const {
    const MeasureSpec& measure = c_.measures[m];
    if (measure.type != MeasureType::front && measure.type != MeasureType::jet) return;
    const bool jet = measure.type == MeasureType::jet;
    const Direction way = jet ? down(c_) : measure.direction;
    const double line = jet ? measure.bottom : measure.position;
    std::size_t beyond = 0;
    for (const Vec3d& p : filling_.fluid.position) beyond += way.sign * (p[way.axis] - line) > 0 ? 1 : 0;
    if (beyond == 0 || static_cast<double>(beyond) < measure.fraction * static_cast<double>(piece_.size()))
      return;
    warnings.push_back("measure '" + measure.name + "' has arrived at the start already: " +
                       percent(beyond, piece_.size()) + " of the fluid is beyond " +
                       (jet ? "bottom = " : "position = ") + show(line) + " m, fraction asks for " +
                       show(100 * measure.fraction) + " %: another position, or the other direction");
  }

  const Case& c_;
  const Filling& filling_;
  const StartSites& sites_;
  const std::vector<std::int32_t>& piece_;  // of each particle
};

}  // namespace

void warn_of_start(const Case& c, const Filling& filling, std::vector<std::string>& warnings) {
  StartSurvey(c, filling).warn(warnings);
}

}  // namespace slagflow
