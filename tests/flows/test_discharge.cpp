// The discharge from the dam at 10/3 mm against the figures of an independent prototype of the same method:
// regime, jet angle and the time at which 0.2 % of the fluid has passed 145 mm below the lip.
#include "flows/flow.hpp"
#include "host/measures/measures.hpp"

namespace slagflow {
namespace {

struct Discharge {
  double travelling_time = 0;  // [s]
  double tan_theta = 0;
  double deepest = 0;     // [spacings] inside a wall
  double mass_error = 0;  // [kg]
  std::int64_t unaccounted = 0;
};

// Depth of a point inside the block under the channel or its walls [m].
double depth_in_walls(Vec3d p) {
  if (p.x >= 0) return 0;
  if (p.z < 0) return std::min(-p.z, -p.x);
  if (p.z > 0.03) return 0;
  return std::max({0.0, std::abs(p.y) - 0.025, -0.1 - p.x});
}

Discharge discharge(std::vector<std::string> overrides) {
  Flow flow("dam_discharge_quick.toml", overrides);
  const auto start = static_cast<double>(flow.setup().particles.position.size());
  const double spacing = flow.setup().spacing;
  constexpr double fraction = 0.002, drop = 0.145;
  constexpr std::size_t front = 1;  // the measure at 145 mm
  Discharge result;
  double last_time = 0, last_passed = 0;
  flow.run(0.4, [&] {
    const Totals t = flow.simulation().totals();
    const double passed = static_cast<double>(t.fronts[front].passed) / start;
    for (const Vec3d& p : flow.snapshot().position)
      result.deepest = std::max(result.deepest, depth_in_walls(p) / spacing);
    if (passed < fraction) {
      last_time = flow.simulation().time(), last_passed = passed;
      return false;
    }
    const double share = (fraction - last_passed) / (passed - last_passed);
    result.travelling_time = last_time + share * (flow.simulation().time() - last_time);
    result.tan_theta = t.fronts[front].mean_position.x / drop;
    return true;
  });
  flow.run(flow.simulation().time() + 0.02);
  const Totals t = flow.simulation().totals();
  std::int64_t departed = 0;
  for (const std::int64_t count : t.departed) departed += count;
  result.unaccounted = static_cast<std::int64_t>(start) - t.particles - departed;
  result.mass_error = t.mass_in + t.mass_left - t.mass_start;
  std::printf("145 mm after %.4f s, tan theta %.3f, deepest %.2f spacings, %lld departed\n",
              result.travelling_time, result.tan_theta, result.deepest, static_cast<long long>(departed));
  return result;
}

std::vector<std::string> newtonian(double density, double viscosity) {
  return {"fluid.slurry={density=" + std::to_string(density) +
          ", rheology=\"newtonian\", dynamic_viscosity=" + std::to_string(viscosity) + "}"};
}

void expect_sound(const Discharge& d) {
  EXPECT_LT(d.deepest, 0.6);
  EXPECT_EQ(d.unaccounted, 0);
  EXPECT_EQ(d.mass_error, 0);
}

TEST(Discharge, OilAIsAFreeJet) {
  const Discharge d = discharge(newtonian(965, 0.0482));
  EXPECT_NEAR(d.travelling_time, 0.181, 0.005);
  EXPECT_GT(d.tan_theta, 0.25);
  EXPECT_LT(d.tan_theta, 0.35);
  expect_sound(d);
}

TEST(Discharge, OilBIsAWeakJet) {
  const Discharge d = discharge(newtonian(970, 0.324));
  EXPECT_NEAR(d.travelling_time, 0.199, 0.005);  // 0.192 without tension, which holds the sheet back
  EXPECT_GT(d.tan_theta, 0.10);
  EXPECT_LT(d.tan_theta, 0.20);
  expect_sound(d);
}

TEST(Discharge, BinghamSlurryRunsDownTheWallWhateverTheGrowthExponent) {
  const Discharge d = discharge({});
  EXPECT_NEAR(d.travelling_time, 0.286, 0.015);
  EXPECT_LT(d.tan_theta, 0.06);
  expect_sound(d);
  const Discharge soft = discharge({"fluid.slurry.growth_exponent=10"});
  EXPECT_NEAR(soft.travelling_time / d.travelling_time, 1, 0.01);
  EXPECT_LT(soft.tan_theta, 0.06);
}

TEST(Discharge, SolversGiveTheSameFlow) {
  const Discharge cg = discharge({"fluid.slurry.growth_exponent=100"});
  const Discharge sor = discharge({"fluid.slurry.growth_exponent=100", "numerics.solver=sor"});
  const Discharge jacobi = discharge(
      {"fluid.slurry.growth_exponent=100", "numerics.solver=jacobi", "numerics.max_iterations=2000"});
  EXPECT_NEAR(sor.travelling_time / cg.travelling_time, 1, 0.01);
  EXPECT_NEAR(jacobi.travelling_time / cg.travelling_time, 1, 0.01);
}

}  // namespace
}  // namespace slagflow
