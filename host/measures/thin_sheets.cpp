#include "host/measures/thin_sheets.hpp"

#include <array>
#include <cstdio>

namespace slagflow {
namespace {

constexpr double tolerated = 0.05;  // of all particles, in thin sheets without a warning

double share(std::int64_t count, std::int64_t start) {
  return static_cast<double>(count) / static_cast<double>(start);
}

}  // namespace

void ThinSheets::look(const Totals& totals, double time) {
  now_ = totals.in_thin_sheets;
  if (now_ > most_) most_ = now_, time_of_most_ = time;
}

std::vector<std::string> ThinSheets::lines(const Case& c, std::int64_t start) const {
  if (most_ == 0) return {};
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(),
      "in sheets thinner than three spacings (%.3g m): %lld particles (%.3g %%) at most, at %.4g s; "
      "%lld at the end",
      3 * c.spacing, static_cast<long long>(most_), 100 * share(most_, start), time_of_most_,
      static_cast<long long>(now_));
  return {text.data()};
}

std::vector<std::string> ThinSheets::warnings(const Case& c, std::int64_t start) const {
  if (!(share(most_, start) > tolerated)) return {};
  std::array<char, 60> half{};
  std::snprintf(half.data(), half.size(), "resolution.spacing = %.3g", c.spacing / 2);
  return {
      "much of the fluid was in sheets thinner than three spacings, which tear by themselves and flow "
      "less exactly (SheetThickness in the snapshots shows where): if they matter, " +
      std::string(half.data()) + " m carries sheets half as thick"};
}

void ThinSheets::add_to(Json& summary) const {
  Json sheets = Json::object();
  sheets.set("most", most_).set("time_of_most", time_of_most_).set("at_end", now_);
  summary.set("in_thin_sheets", sheets);
}

}  // namespace slagflow
