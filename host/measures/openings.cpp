#include "host/measures/openings.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace slagflow {
namespace {

std::string line(const char* pattern, const std::string& name, std::int64_t count, double mass) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), pattern, name.c_str(), static_cast<long long>(count), mass);
  return text.data();
}

}  // namespace

Openings::Openings(const SimulationSetup& setup) : inlets_(setup.inlets), outlets_(setup.outlets) {}

std::vector<std::string> Openings::columns() const {
  std::vector<std::string> names;
  for (const InletSetup& in : inlets_) names.push_back(in.name + "_mass_fed_kg");
  for (const OutletSetup& out : outlets_) names.push_back(out.name + "_mass_removed_kg");
  return names;
}

std::vector<double> Openings::values(const Totals& totals) const {
  std::vector<double> values = totals.fed_mass;
  values.insert(values.end(), totals.removed_mass.begin(), totals.removed_mass.end());
  return values;
}

std::vector<std::string> Openings::lines(const Totals& totals) const {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < inlets_.size(); ++k)
    lines.push_back(
        line("inlet %s fed %lld particles, %.6g kg", inlets_[k].name, totals.fed[k], totals.fed_mass[k]));
  for (std::size_t k = 0; k < outlets_.size(); ++k)
    lines.push_back(line("outlet %s took %lld particles, %.6g kg", outlets_[k].name, totals.removed[k],
                         totals.removed_mass[k]));
  return lines;
}

void Openings::add_to(Json& summary, const Totals& totals) const {
  if (inlets_.empty() && outlets_.empty()) return;
  Json inlets = Json::object(), outlets = Json::object();
  for (std::size_t k = 0; k < inlets_.size(); ++k)
    inlets.set(inlets_[k].name,
               Json::object().set("particles", totals.fed[k]).set("mass", totals.fed_mass[k]));
  for (std::size_t k = 0; k < outlets_.size(); ++k)
    outlets.set(outlets_[k].name,
                Json::object().set("particles", totals.removed[k]).set("mass", totals.removed_mass[k]));
  summary.set("inlets", inlets).set("outlets", outlets).set("mass_fed", totals.mass_fed);
}

bool Openings::feeds_after(double time) const {
  return std::any_of(inlets_.begin(), inlets_.end(),
                     [&](const InletSetup& in) { return in.rate.travelled(1e30) > in.rate.travelled(time); });
}

}  // namespace slagflow
