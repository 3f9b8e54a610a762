// From viscosities over temperature to the liquid_viscosity of a [fluid] table.
#pragma once

#include "host/rheometry/rheometry_options.hpp"
#include "host/rheometry/rheometry_output.hpp"

namespace slagflow {

struct MeltResult {
  ViscositySeries series;     // that is fitted
  std::vector<MeltFit> fits;  // best first by AICc
  std::size_t chosen = 0;
  std::optional<Kink> kink;
  std::vector<std::string> warnings;

  const MeltFit& best() const { return fits[chosen]; }
};

// Throws InputError on a law that does not fit the readings.
MeltResult analyse_melt(const Measurements& measured, const RheometryOptions& options);

Answer melt_answer(const Measurements& measured, const RheometryOptions& options);

// [fluid.NAME] of a case with [thermal], from a law.
std::string melt_table(const std::string& name, const SampleFacts& facts, const LiquidViscosity& liquid);

}  // namespace slagflow
