// What the command `rheometry` is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_composition.hpp"
#include "host/rheometry/rheometry_data.hpp"

namespace slagflow {

struct RheometryOptions {
  std::string file;
  std::optional<FlowModel> model;  // else the best by AICc
  std::optional<LiquidLaw> law;    // the same over temperature
  std::optional<double> above;     // [K] only readings of at least that
  std::string output;              // TOML file; empty: none
  SampleFacts facts;               // given as options
  ErrorModel errors = ErrorModel::absolute;
  double growth_exponent = 1000;  // [s]
  bool phases = false;            // the file is of thermodynamics software
  std::optional<double> mass;     // [kg] of what its amounts and enthalpies are of
  std::string composition;        // in place of a file: "CaO=42,SiO2=36"
  bool mole = false;              // in mole per cent
  std::optional<SlagModel> slag_model;
};

// Of all kinds, "auto" first.
std::vector<std::string> model_names();
void set_model(const std::string& name, RheometryOptions& options);

}  // namespace slagflow
