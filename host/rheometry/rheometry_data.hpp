// Reads what a viscometer measured: tables of text with a line of names, such as
//   # density_kg/m3 = 2600
//   shear_rate_1/s,shear_stress_Pa
//   1,4.56
// and what makers' programs and spreadsheets export. Columns: a pair of shear rate, shear stress and
// viscosity; or rotation with torque, or with viscosity and a spindle; or temperature with any of these.
// Keys, `# key = value`:
//   bob_radius_m, cup_radius_m, height_m    with rotation and torque; or a spindle
//   full_scale_torque_Nm                    with torque_percent
//   decimal                                 point or comma
//   density_kg/m3, name                     for the [fluid] table
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_fit.hpp"
#include "host/rheometry/rheometry_melt_fit.hpp"

namespace slagflow {

// What else must be known; options of the command go before the keys of the file. SI units.
struct SampleFacts {
  std::optional<double> bob_radius, cup_radius, height;  // [m]
  std::optional<double> full_scale_torque;               // [N m]
  std::optional<double> density;                         // [kg/m^3]
  std::optional<std::string> name;
  std::optional<std::string> spindle;  // of Brookfield
  std::optional<int> table;            // from 1: only this one of several in the file
  bool over_temperature = false;       // the readings are of that, whatever else varies
};

struct Measurements {
  FlowCurve curve;         // in ascending order of the rate
  ViscositySeries series;  // where temperature is what varies: in place of the curve
  SampleFacts facts;
  std::string how;  // it was read: encoding, signs, lines, columns and units
  std::vector<std::string> warnings;
};

// Throws InputError, one line for each thing that is wrong, with file, line, column, value and what is
// allowed: unknown units, missing geometry, values that are not numbers or not above 0, a stress that falls
// by more than a fifth while the rate rises, too few points.
Measurements read_measurements(const std::string& path, const SampleFacts& options);

// The same from text; `file` stands for it in messages.
Measurements parse_measurements(const std::string& text, const std::string& file,
                                const SampleFacts& options = {});

// Bytes of a file. Throws InputError.
std::string read_whole_file(const std::string& path);

}  // namespace slagflow
