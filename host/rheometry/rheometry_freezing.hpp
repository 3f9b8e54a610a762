// What a case needs of a table of phases: the solid fraction and the heat, in few rows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fluid/material.hpp"
#include "host/rheometry/rheometry_phase_table.hpp"

namespace slagflow {

// At most `most` of the rows, with which all are met by straight lines within a distance; `off` becomes the
// largest that is left. First and last stay.
ValueRows thinned(const ValueRows& rows, double within, std::size_t most, double& off);

// Of what value_at() gives.
double integral(const ValueRows& rows, double from, double to);

struct Freezing {
  ValueRows solids;  // [K], fraction: rising temperatures, 1 falling to 0
  double off = 0;    // of the file's, at most
};

// Falls of the fraction that come with cooling are taken out; ends that the table does not reach are added.
// Throws InputError where either is large.
Freezing freezing_of(const PhaseTable& table, const std::string& file, std::vector<std::string>& warnings);

struct MeltHeat {
  ValueRows heat_capacity;            // [K], [J/(kg K)]
  std::optional<double> latent_heat;  // [J/kg] nothing: there is no enthalpy to tell it
  double off = 0;                     // [J/kg] of the file's enthalpy, at most
};

// So that (H2) gives the enthalpies of the table. Nothing without enthalpy and heat capacity.
std::optional<MeltHeat> heat_of(const PhaseTable& table, const ValueRows& solids, const std::string& file,
                                std::vector<std::string>& warnings);

}  // namespace slagflow
