// Reads what a viscometer measured.
//
// A CSV file: comment lines begin with # and may hold `key = value`; the first other line names the columns,
// each with its unit; then a line of numbers for each point. Comma, semicolon or tab separate.
//   columns   shear_rate_1/s or _1/min, and shear_stress_Pa, _mPa or _kPa
//        or   rotation_rpm, _rad/s or _1/s, and torque_Nm, _mNm, _uNm or _percent
//   keys      bob_radius_m or _mm, cup_radius_m or _mm, height_m or _mm: with rotation
//             full_scale_torque_Nm, _mNm or _uNm: with torque_percent
//             density_kg/m3 or _g/cm3, name: for the [fluid] table
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_fit.hpp"

namespace slagflow {

// What else must be known; options of the command go before the keys of the file. SI units.
struct SampleFacts {
  std::optional<double> bob_radius, cup_radius, height;  // [m]
  std::optional<double> full_scale_torque;               // [N m]
  std::optional<double> density;                         // [kg/m^3]
  std::optional<std::string> name;
};

struct Measurements {
  FlowCurve curve;  // in ascending order of the rate
  SampleFacts facts;
  std::vector<std::string> warnings;
};

// Throws InputError, one line for each thing that is wrong, with file, line, column, value and what is
// allowed: unknown units, missing geometry, values that are not numbers or not above 0, a stress that falls
// by more than a fifth while the rate rises, too few points.
Measurements read_measurements(const std::string& path, const SampleFacts& options);

// The same from text; `file` stands for it in messages.
Measurements parse_measurements(const std::string& text, const std::string& file,
                                const SampleFacts& options = {});

}  // namespace slagflow
