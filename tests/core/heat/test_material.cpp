// Tables of what enthalpy tells.
#include <gtest/gtest.h>

#include <cmath>

#include "heat/material_table.hpp"

namespace slagflow {
namespace {

constexpr OwnRheology own{2, 3};

MaterialSetup slag() {
  MaterialSetup m;
  m.heat_capacity = {{298, 900}, {1473, 1150}, {1673, 1350}};
  m.conductivity = {{298, 1.0}, {1473, 1.5}, {1673, 0.7}};
  m.solid_fraction = {{1473, 1}, {1573, 0.5}, {1623, 0.2}, {1673, 0}};
  m.latent_heat = 2.09e5;
  m.liquid.law = LiquidLaw::weymann, m.liquid.a = 3.008e-9, m.liquid.b = 19826;
  m.suspended = true;
  m.suspension.critical_fraction = 0.6, m.suspension.exponent = 2.5;
  m.yield_stress = {{0.2, 0}, {0.4, 5}, {0.6, 500}};
  return m;
}

struct Table {
  Table(const MaterialSetup& m, double reference) : rows(material_rows(m, own, reference)) {
    material = {{rows.data(), static_cast<Offset>(rows.size())},
                static_cast<Real>(std::log(m.max_viscosity) * (1 - 1e-6))};
  }
  std::vector<MaterialRow> rows;
  Material material;
};

// [J/kg] between two temperatures: c as a trapezoid, solids by the table.
double enthalpy_between(const MaterialSetup& m, double from, double to) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += value_at(m.heat_capacity, from + (to - from) * (k + 0.5) / steps);
  return sum * (to - from) / steps + m.latent_heat * (solid_fraction_at(m, from) - solid_fraction_at(m, to));
}

TEST(Material, TellsTemperatureAndSolidsOfAnEnthalpy) {
  const Table table(slag(), 1773);
  for (const double t : {320.0, 1000.0, 1472.0, 1500.0, 1600.0, 1650.0, 1700.0, 1773.0, 2500.0}) {
    const MaterialRow row = table.material.at_enthalpy(enthalpy_between(slag(), 298.15, t));
    EXPECT_NEAR(static_cast<double>(row.temperature), t - 1773, 0.01) << t;
    EXPECT_NEAR(static_cast<double>(row.fraction), solid_fraction_at(slag(), t), 1e-5) << t;
    EXPECT_NEAR(static_cast<double>(row.conductivity), value_at(slag().conductivity, t), 1e-4) << t;
  }
}

TEST(Material, IntegratesConductivity) {
  const Table table(slag(), 1773);
  const auto theta = [&](double t) {
    return static_cast<double>(table.material.potential_at(static_cast<Real>(t - 1773)));
  };
  EXPECT_NEAR(theta(1773) - theta(1673), 70, 0.01);
  EXPECT_NEAR(theta(1673) - theta(1473), 220, 0.02);
  EXPECT_NEAR(theta(1473) - theta(298), 1.25 * 1175, 0.02);
}

// At one temperature it takes all of the latent heat, however it is spread, and the heat is the same.
TEST(Material, FreezesAtOneTemperatureOrOverARange) {
  for (const double width : {0.0, 1.0, 10.0, 50.0, 200.0}) {
    MaterialSetup m = slag();
    m.solid_fraction = {{1600 - width, 1}, {1600, 0}};
    const Table table(m, 1773);
    const double liquid = enthalpy_between(m, 298.15, 1600);
    EXPECT_NEAR(static_cast<double>(table.material.at_enthalpy(liquid).fraction), 0, 1e-6);
    EXPECT_NEAR(static_cast<double>(table.material.at_enthalpy(liquid).temperature), 1600 - 1773, 0.01);
    const double half =
        width > 0 ? enthalpy_between(m, 298.15, 1600 - 0.5 * width) : liquid - 0.5 * m.latent_heat;
    const MaterialRow row = table.material.at_enthalpy(half);
    EXPECT_NEAR(static_cast<double>(row.temperature), 1600 - 1773 - 0.5 * width, 0.01) << width;
    EXPECT_NEAR(static_cast<double>(row.fraction), 0.5, 1e-3) << width;
    const double solid = width > 0 ? enthalpy_between(m, 298.15, 1600 - width) : liquid - m.latent_heat;
    EXPECT_NEAR(static_cast<double>(table.material.at_enthalpy(solid).fraction), 1, 1e-6) << width;
  }
}

// Urbain's model of a blast furnace slag (42CaO-36SiO2-14Al2O3-8MgO) at 1500 degrees Celsius: 0.3827 Pa s.
TEST(Material, GivesViscosities) {
  MaterialSetup m = slag();
  EXPECT_NEAR(viscosity_at(m, own, 1773.15), 0.38273, 2e-4);
  const Table table(m, 1773);
  const auto melt = [&](double t) {
    return table.material.melt(table.material.at_temperature(static_cast<Real>(t - 1773)));
  };
  EXPECT_NEAR(static_cast<double>(melt(1773.15).viscosity), 0.38273, 4e-4);
  EXPECT_EQ(static_cast<double>(melt(1773.15).yield_stress), 0);
  // Einstein and Roscoe at 0.2 of 0.6: (2/3)^-2.5.
  const double liquid = 3.008e-9 * 1623 * std::exp(19826.0 / 1623);
  EXPECT_NEAR(static_cast<double>(melt(1623).viscosity), liquid * std::pow(2.0 / 3, -2.5), 3e-3 * liquid);
  EXPECT_FALSE(melt(1623).is_solid());
  EXPECT_TRUE(melt(1500).is_solid());
  EXPECT_NEAR(static_cast<double>(melt(1500).viscosity), 1e6, 5);
  EXPECT_EQ(static_cast<double>(melt(1500).yield_stress), 0);
  EXPECT_NEAR(static_cast<double>(melt(1590).yield_stress), 5 * (0.398 - 0.2) / 0.2, 0.1);
}

TEST(Material, LeavesTheRheologyItsOwnValues) {
  MaterialSetup m = slag();
  m.solid_fraction.clear(), m.yield_stress.clear(), m.liquid = {}, m.suspended = false, m.latent_heat = 0;
  const Table table(m, 1773);
  const Melt melt = table.material.melt(table.material.at_temperature(-500));
  EXPECT_NEAR(static_cast<double>(melt.viscosity), own.viscosity, 1e-6);
  EXPECT_EQ(static_cast<double>(melt.yield_stress), own.yield_stress);
  EXPECT_FALSE(melt.is_solid());
}

TEST(LiquidViscosity, FollowsItsLaws) {
  LiquidViscosity liquid;
  liquid.law = LiquidLaw::arrhenius, liquid.a = 1e-5, liquid.b = 15000;
  EXPECT_NEAR(std::exp(log_liquid_viscosity(liquid, 1500)), 1e-5 * std::exp(10.0), 1e-9);
  liquid.law = LiquidLaw::vft, liquid.t0 = 500;
  EXPECT_NEAR(std::exp(log_liquid_viscosity(liquid, 1500)), 1e-5 * std::exp(15.0), 1e-7);
  liquid.law = LiquidLaw::table, liquid.rows = {{1400, 10}, {1600, 0.1}};
  EXPECT_NEAR(std::exp(log_liquid_viscosity(liquid, 1300)), 10, 1e-9);
  EXPECT_NEAR(std::exp(log_liquid_viscosity(liquid, 1 / (0.5 / 1400 + 0.5 / 1600))), 1, 1e-9);
}

}  // namespace
}  // namespace slagflow
