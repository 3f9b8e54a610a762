// From tables to readings: which columns are taken, which sign is decimal, what the numbers are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_table.hpp"
#include "host/text/number_text.hpp"

namespace slagflow {

// A reading in SI units. `second` is a shear stress, a torque (of full scale where in per cent), or a
// viscosity; of a series over temperature with viscosities the first is the
// temperature.
struct Reading {
  double first = 0, second = 0;
  int line = 0;
  std::size_t table = 0;
  double viscosity = 0;    // [Pa s] that the file gives beside a torque; 0: none
  double temperature = 0;  // [K] of a series over temperature
};

struct ReadingsOptions {
  std::optional<DecimalSign> decimal;
  bool cylinders = false;         // a geometry or a spindle is given: rotation goes before shear rate
  bool spindle = false;           // then rotation and viscosity are a pair too
  std::optional<int> only;        // this table, from 1
  bool over_temperature = false;  // else where the temperature is what varies
};

struct Readings {
  std::vector<Reading> readings;
  Quantity first = Quantity::shear_rate, second = Quantity::shear_stress;
  bool percent = false;           // the second
  bool over_temperature = false;  // each reading has a temperature
  std::string how;
  std::vector<std::string> warnings;  // with file and line
};

// What cannot be is added to the problems.
Readings read_tables(const Tables& tables, const ReadingsOptions& options, const std::string& file,
                     std::vector<Problem>& problems);

}  // namespace slagflow
