#include "host/rheometry/rheometry_units.hpp"

namespace slagflow {
namespace {

constexpr double turn = 6.283185307179586;  // [rad]
constexpr const char* percent = "percent";

}  // namespace

const std::vector<QuantityInfo>& quantities() {
  static const std::vector<QuantityInfo> all{
      {"shear_rate", {{"1/s", 1}, {"1/min", 1.0 / 60}}, 0, 1e7},
      {"shear_stress", {{"Pa", 1}, {"mPa", 1e-3}, {"kPa", 1e3}}, 0, 1e6},
      {"rotation", {{"rad/s", 1}, {"rpm", turn / 60}, {"1/s", turn}}, 0, 1e4},
      {"torque", {{"Nm", 1}, {"mNm", 1e-3}, {"uNm", 1e-6}, {percent, 0.01}}, 0, 1e3},
      {"bob_radius", {{"m", 1}, {"mm", 1e-3}}, 0, 0.5},
      {"cup_radius", {{"m", 1}, {"mm", 1e-3}}, 0, 1},
      {"height", {{"m", 1}, {"mm", 1e-3}}, 0, 1},
      {"full_scale_torque", {{"Nm", 1}, {"mNm", 1e-3}, {"uNm", 1e-6}}, 0, 1e3},
      {"density", {{"kg/m3", 1}, {"g/cm3", 1e3}}, 50, 25000},
  };
  return all;
}

NamedQuantity parse_name(const std::string& name) {
  NamedQuantity found;
  std::size_t longest = 0;
  for (std::size_t q = 0; q < quantities().size(); ++q) {
    const std::string quantity = quantities()[q].name;
    const bool begins = name == quantity || name.compare(0, quantity.size() + 1, quantity + "_") == 0;
    if (!begins || quantity.size() <= longest) continue;
    longest = quantity.size();
    found = {};
    found.known = true;
    found.quantity = static_cast<Quantity>(q);
    for (const UnitInfo& unit : quantities()[q].units) {
      if (name != quantity + "_" + unit.name) continue;
      found.unit_known = true;
      found.factor = unit.factor;
      found.percent = unit.name == percent;
    }
  }
  return found;
}

std::string names_of(Quantity q) {
  std::string all;
  for (const UnitInfo& unit : info(q).units)
    all += (all.empty() ? "" : ", ") + std::string(info(q).name) + "_" + unit.name;
  return all;
}

}  // namespace slagflow
