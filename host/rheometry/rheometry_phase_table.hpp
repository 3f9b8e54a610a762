// Reads a table of thermodynamics software over temperature.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_data.hpp"

namespace slagflow {

struct PhaseRow {
  double temperature = 0;                         // [K]
  double solids = 0;                              // fraction, as measured in the file: of mass or volume
  std::optional<double> enthalpy, heat_capacity;  // [J/kg], [J/(kg K)]
  int line = 0;
};

struct PhaseTable {
  std::vector<PhaseRow>
      rows;  // in ascending order of the temperature; of equal ones the solid before the liquid
  SampleFacts facts;
  std::string how;
  std::vector<std::string> warnings;
};

// `mass` [kg]: of what amounts in per cent and enthalpies in joules are of. Throws InputError.
PhaseTable parse_phases(const std::string& text, const std::string& file, const SampleFacts& options,
                        std::optional<double> mass);

}  // namespace slagflow
