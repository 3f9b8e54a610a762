// Tables of what enthalpy tells: temperature, conduction potential, solid fraction, viscosity, yield stress.
#pragma once

#include <vector>

#include "backend/span.hpp"
#include "fluid/material.hpp"
#include "fluid/melt.hpp"
#include "fluid/thermal.hpp"

namespace slagflow {

// A state of a fluid, and a row of its table; between rows everything but the enthalpy is linear in the
// enthalpy. Temperatures are relative to ThermalSetup::reference_temperature, so that small changes of what
// is stored in single precision are kept.
struct MaterialRow {
  double enthalpy = 0;     // [J/kg] above that at 298.15 K
  Real temperature = 0;    // [K]
  Real potential = 0;      // Theta, the integral of the conductivity over temperature [W/m]
  Real conductivity = 0;   // [W/(m K)]
  Real fraction = 0;       // of solids
  Real log_viscosity = 0;  // of K(T) [Pa s], at most that of max_viscosity
  Real yield_stress = 0;   // [Pa]
};

// (H2): h(T) = integral of c dT + L (phi(298.15 K) - phi(T)); rows at all break points, every 5 K and, where
// it freezes, every kelvin or closer, from 150 to 4500 K. `own`: the rheology's own viscosity and yield
// stress, which stay where the material tells of none.
struct OwnRheology {
  double viscosity = 0, yield_stress = 0;  // [Pa s], [Pa]
};
std::vector<MaterialRow> material_rows(const MaterialSetup&, OwnRheology own, double reference_temperature);

// Of one temperature [K], the liquid side of one at which it freezes.
double solid_fraction_at(const MaterialSetup&, double temperature);
double viscosity_at(const MaterialSetup&, OwnRheology own, double temperature);  // K(T) [Pa s]
double value_at(const ValueRows&, double abscissa);

struct Material {
  Span<const MaterialRow> rows;  // of one fluid
  Real solid_from = 0;           // log_viscosity of solid fluid

  HOST_DEVICE MaterialRow at_enthalpy(double enthalpy) const {
    const Offset k = segment([&](const MaterialRow& row) { return row.enthalpy <= enthalpy; });
    const MaterialRow &a = rows[k], &b = rows[k + 1];
    const double share = (enthalpy - a.enthalpy) / (b.enthalpy - a.enthalpy);
    return between(a, b, share);
  }
  // The liquid side of a temperature at which it freezes.
  HOST_DEVICE MaterialRow at_temperature(Real temperature) const {
    const Offset k = segment([&](const MaterialRow& row) { return row.temperature <= temperature; });
    const MaterialRow &a = rows[k], &b = rows[k + 1];
    const Real width = b.temperature - a.temperature;
    return between(a, b, width > 0 ? static_cast<double>((temperature - a.temperature) / width) : 1);
  }
  HOST_DEVICE Real potential_at(Real temperature) const {
    const Offset k = segment([&](const MaterialRow& row) { return row.temperature <= temperature; });
    const MaterialRow &a = rows[k], &b = rows[k + 1];
    const Real width = b.temperature - a.temperature;
    return width > 0 ? a.potential + (temperature - a.temperature) / width * (b.potential - a.potential)
                     : b.potential;
  }
  HOST_DEVICE Melt melt(const MaterialRow& row) const {
    const bool solid = row.log_viscosity >= solid_from;
    return Melt({std::exp(row.log_viscosity), solid ? Real(0) : row.yield_stress, solid ? Real(1) : Real(0),
                 std::exp(row.log_viscosity)});
  }

 private:
  // The last k, up to one before the end, whose row is not beyond.
  template <class NotBeyond>
  HOST_DEVICE Offset segment(NotBeyond not_beyond) const {
    Offset low = 0, high = rows.size - 1;
    while (high - low > 1) {
      const Offset middle = (low + high) / 2;
      (not_beyond(rows[middle]) ? low : high) = middle;
    }
    return low;
  }
  // Beyond the ends temperature and potential go on as before, the others stay.
  HOST_DEVICE static MaterialRow between(const MaterialRow& a, const MaterialRow& b, double share) {
    const auto s = static_cast<Real>(share), inside = smaller(Real(1), larger(Real(0), s));
    MaterialRow row;
    row.enthalpy = a.enthalpy + share * (b.enthalpy - a.enthalpy);
    row.temperature = a.temperature + s * (b.temperature - a.temperature);
    row.potential = a.potential + s * (b.potential - a.potential);
    row.conductivity = a.conductivity + inside * (b.conductivity - a.conductivity);
    row.fraction = a.fraction + inside * (b.fraction - a.fraction);
    row.log_viscosity = a.log_viscosity + inside * (b.log_viscosity - a.log_viscosity);
    row.yield_stress = a.yield_stress + inside * (b.yield_stress - a.yield_stress);
    return row;
  }
};

// The tables of all fluids.
struct Materials {
  Span<const MaterialRow> rows;
  Span<const Index> first;  // row of each fluid, and one beyond the last
  Span<const Real> solid_from;

  HOST_DEVICE Material of(std::uint8_t fluid) const {
    const Index from = first[fluid];
    return {{rows.data + from, static_cast<Offset>(first[fluid + 1] - from)}, solid_from[fluid]};
  }
};

}  // namespace slagflow
