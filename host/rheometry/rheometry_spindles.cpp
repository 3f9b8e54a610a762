#include "host/rheometry/rheometry_spindles.hpp"

#include <array>
#include <cmath>

#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

constexpr double pi = 3.141592653589793;
constexpr double lv_torque = 673.7e-7, rv_torque = 7187e-7;  // [N m]

// Viscosity [mPa s] times speed [rpm] for each per cent of full scale.
constexpr std::array<double, 4> lv_factors{60, 300, 1200, 6000};
constexpr std::array<double, 7> rv_factors{100, 400, 1000, 2000, 4000, 10000, 40000};
constexpr double percents = 100, milli = 1e-3;

constexpr int first_lv_code = 61;

template <std::size_t count>
std::optional<Spindle> of_series(const char* series, int number, double torque,
                                 const std::array<double, count>& factors) {
  if (number < 1 || number > static_cast<int>(count)) return {};
  return Spindle{series + std::string("-") + std::to_string(number), torque,
                 factors[static_cast<std::size_t>(number - 1)] * percents * milli};
}

}  // namespace

Cylinders Spindle::cylinders() const {
  Cylinders like{0.01, 1, 1};  // [m] radii; the height follows
  const double rate = like.nominal_rate(2 * pi / 60);
  like.height = full_scale / (2 * pi * like.bob_radius * like.bob_radius * factor * rate);
  return like;
}

std::optional<Spindle> find_spindle(const std::string& name) {
  std::string plain = replaced(
      lower_case(trimmed(name)),
      {{"brookfield", ""}, {"spindle", ""}, {"no.", ""}, {"#", ""}, {" ", ""}, {"-", ""}, {"_", ""}});
  if (const std::size_t code = plain.find('('); code != std::string::npos && code > 0)
    plain.erase(code);  // LV-02 (62)
  const std::size_t digits = plain.find_first_of("0123456789");
  if (digits == std::string::npos || plain.size() - digits > 2) return {};
  if (plain.find_first_not_of("0123456789", digits) != std::string::npos) return {};
  const std::string series = plain.substr(0, digits);
  const int number = std::stoi(plain.substr(digits));
  if (series == "rv" || series == "rvt") return of_series("RV", number, rv_torque, rv_factors);
  if (number >= first_lv_code && (series.empty() || series == "s" || series == "sp" || series == "lv"))
    return of_series("LV", number - first_lv_code + 1, lv_torque, lv_factors);
  if (series == "lv" || series == "lvt") return of_series("LV", number, lv_torque, lv_factors);
  return {};
}

}  // namespace slagflow
