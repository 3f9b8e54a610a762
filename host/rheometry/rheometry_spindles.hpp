// Spindles of Brookfield's dial and digital viscometers, series LV and RV.
#pragma once

#include <optional>
#include <string>

#include "host/rheometry/rheometry_models.hpp"

namespace slagflow {

struct Spindle {
  std::string name;       // "LV-2"
  double full_scale = 0;  // [N m] torque of the series
  double factor = 0;      // [Pa s rpm] viscosity times speed at full scale, by the maker

  // A cylinder in a wide vessel that gives a Newtonian fluid the viscosity that the factor does.
  Cylinders cylinders() const;
};

// LV-1 to LV-4, which newer ones call 61 to 64, and RV-1 to RV-7; written LV2, lv 2, LV-62, S62, 62 too.
std::optional<Spindle> find_spindle(const std::string& name);

inline constexpr const char* allowed_spindles = "LV-1 to LV-4 (61 to 64), RV-1 to RV-7";

}  // namespace slagflow
