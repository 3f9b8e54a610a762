#include <algorithm>
#include <cmath>

#include "heat/material_table.hpp"

namespace slagflow {

namespace {

constexpr double lowest = 150, highest = 4500, zero_enthalpy = 298.15;  // [K]

// A temperature of the table; where the fluid freezes at one, how far it has.
struct Knot {
  double temperature, fraction;
};

void add_between(double from, double to, double step, std::vector<double>& knots) {
  const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)));
  for (int k = 0; k < parts; ++k) knots.push_back(from + (to - from) * k / parts);
}

// Whether the solid fraction changes between two temperatures.
bool freezes(const MaterialSetup& m, double from, double to) {
  const ValueRows& phi = m.solid_fraction;
  return !phi.empty() && from < phi.back()[0] && to > phi.front()[0];
}

std::vector<double> temperatures(const MaterialSetup& m) {
  std::vector<double> breaks{lowest, highest, zero_enthalpy};
  for (const ValueRows* rows : {&m.heat_capacity, &m.conductivity, &m.solid_fraction, &m.liquid.rows})
    for (const auto& row : *rows)
      if (row[0] > lowest && row[0] < highest) breaks.push_back(row[0]);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  std::vector<double> knots;
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const double width = breaks[k] - breaks[k - 1];
    add_between(breaks[k - 1], breaks[k],
                freezes(m, breaks[k - 1], breaks[k]) ? std::min(1.0, width / 32) : 5, knots);
  }
  knots.push_back(highest);
  return knots;
}

// The two sides of a temperature at which it freezes, and steps between them.
std::vector<Knot> knots_of(const MaterialSetup& m) {
  constexpr int steps = 64;
  std::vector<Knot> knots;
  for (const double t : temperatures(m)) {
    double solid = solid_fraction_at(m, t);
    for (std::size_t k = 1; k < m.solid_fraction.size(); ++k)
      if (m.solid_fraction[k][0] == t && m.solid_fraction[k - 1][0] == t) {
        const double from = m.solid_fraction[k - 1][1], to = m.solid_fraction[k][1];
        for (int s = 0; s < steps; ++s) knots.push_back({t, from + (to - from) * s / steps});
        solid = to;
      }
    knots.push_back({t, solid});
  }
  return knots;
}

// ln K at a temperature and solid fraction, at most that of solid fluid.
double log_viscosity(const MaterialSetup& m, OwnRheology own, const Knot& at) {
  const double most = std::log(m.max_viscosity);
  double log_eta = m.liquid.law == LiquidLaw::constant && !(m.liquid.a > 0)
                       ? std::log(own.viscosity)
                       : log_liquid_viscosity(m.liquid, at.temperature);
  if (m.suspended) {
    const double critical =
        m.suspension.critical_fraction > 0 ? m.suspension.critical_fraction : thomas_limit;
    if (at.fraction >= critical) return most;
    log_eta += std::log(relative_viscosity(m.suspension, at.fraction));
  } else if (at.fraction >= 1) {
    return most;
  }
  return std::min(log_eta, most);
}

}  // namespace

double value_at(const ValueRows& rows, double abscissa) {
  if (abscissa >= rows.back()[0]) return rows.back()[1];
  if (abscissa < rows.front()[0]) return rows.front()[1];
  std::size_t k = 1;
  while (rows[k][0] <= abscissa) ++k;
  const auto [x0, y0] = rows[k - 1];
  const auto [x1, y1] = rows[k];
  return y0 + (y1 - y0) * (abscissa - x0) / (x1 - x0);
}

double solid_fraction_at(const MaterialSetup& m, double temperature) {
  return m.solid_fraction.empty() ? 0 : value_at(m.solid_fraction, temperature);
}

double viscosity_at(const MaterialSetup& m, OwnRheology own, double temperature) {
  return std::exp(log_viscosity(m, own, {temperature, solid_fraction_at(m, temperature)}));
}

std::vector<MaterialRow> material_rows(const MaterialSetup& m, OwnRheology own, double reference) {
  const std::vector<Knot> knots = knots_of(m);
  std::vector<double> enthalpy{0}, potential{0};
  double at_zero = 0, at_reference = 0;
  const auto notes = [&](std::size_t k) {
    if (knots[k].temperature <= zero_enthalpy) at_zero = enthalpy[k];
    if (knots[k].temperature <= reference) at_reference = potential[k];
  };
  notes(0);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const Knot &a = knots[k - 1], &b = knots[k];
    const double width = b.temperature - a.temperature;
    const double c =
        0.5 * (value_at(m.heat_capacity, a.temperature) + value_at(m.heat_capacity, b.temperature));
    const double k_mean =
        0.5 * (value_at(m.conductivity, a.temperature) + value_at(m.conductivity, b.temperature));
    enthalpy.push_back(enthalpy.back() + c * width + m.latent_heat * (a.fraction - b.fraction));
    potential.push_back(potential.back() + k_mean * width);
    notes(k);
  }
  std::vector<MaterialRow> rows;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const auto [t, phi] = knots[k];
    if (k > 0 && !(enthalpy[k] > enthalpy[k - 1])) continue;  // it freezes without latent heat
    const double yield = m.yield_stress.empty()            ? own.yield_stress
                         : phi < m.yield_stress.front()[0] ? 0
                                                           : value_at(m.yield_stress, phi);
    rows.push_back({enthalpy[k] - at_zero, static_cast<Real>(t - reference),
                    static_cast<Real>(potential[k] - at_reference),
                    static_cast<Real>(value_at(m.conductivity, t)), static_cast<Real>(phi),
                    static_cast<Real>(log_viscosity(m, own, knots[k])), static_cast<Real>(yield)});
  }
  return rows;
}

}  // namespace slagflow
