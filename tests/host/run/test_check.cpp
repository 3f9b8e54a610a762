#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/run/check.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

// A block of 5 x 10 x 2 particles of 10 mm: 50 mm wide (L), 20 mm deep (H).
BuiltCase block() {
  BuiltCase built;
  SimulationSetup& s = built.setup;
  s.spacing = 0.01;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 2; ++k) s.particles.position.push_back({0.01 * i, 0.01 * j, 0.01 * k});
  s.particles.velocity.resize(s.particles.position.size());
  s.walls.position.resize(30);
  s.numerics.sound_speed = 7;
  FluidSetup oil;
  oil.name = "oil";
  oil.rest_density = 965;
  oil.rheology.kind = RheologyKind::bingham;
  oil.rheology.parameters[0] = static_cast<Real>(0.5);
  oil.rheology.parameters[1] = 5;
  s.fluids.push_back(oil);
  built.resolved.output.end_time = 1;
  return built;
}

TEST(CaseCheck, NumbersFollowTheirFormulas) {
  const CaseCheck c = check_case(block());
  EXPECT_EQ(c.fluid_particles, 100);
  EXPECT_NEAR(c.width, 0.05, 1e-12);
  EXPECT_NEAR(c.depth, 0.02, 1e-12);
  const double speed = std::sqrt(2 * 9.81 * 0.02);
  EXPECT_NEAR(c.speed, speed, 1e-12);
  EXPECT_EQ(c.speed_source, "sqrt(2 g H)");
  EXPECT_NEAR(c.fluids[0].reynolds, 965 * speed * 0.05 / 0.5, 1e-9);
  EXPECT_NEAR(c.fluids[0].bingham, 5 * 0.05 / (0.5 * speed), 1e-9);
  EXPECT_NEAR(c.fluids[0].dam, 965 * 0.05 * std::sqrt(9.81 * 0.02) / 0.5, 1e-9);
  EXPECT_NEAR(c.mach, speed / 7, 1e-12);
  EXPECT_NEAR(c.memory, 100 * 2000.0 + 30 * 300.0, 1e-6);
}

TEST(CaseCheck, TimeStepNamesItsLimit) {
  BuiltCase built = block();
  const double acoustic = built.setup.numerics.courant * 0.013 / 7;
  EXPECT_NEAR(check_case(built).time_step, acoustic, 1e-12);
  EXPECT_THAT(check_case(built).time_step_reason, testing::HasSubstr("sound speed"));
  EXPECT_EQ(check_case(built).steps, std::ceil(1 / acoustic));
  built.setup.numerics.max_time_step = 1e-4;
  EXPECT_EQ(check_case(built).time_step, 1e-4);
  EXPECT_THAT(check_case(built).time_step_reason, testing::HasSubstr("max_time_step"));
  EXPECT_THAT(check_case(built).warnings, testing::Not(testing::Contains(testing::HasSubstr("1e9"))));
  built.resolved.output.end_time = 2e5;
  EXPECT_THAT(
      check_case(built).warnings,
      testing::Contains(testing::HasSubstr("2e+09 steps to output.end_time = 200000 s, more than 1e9")));
}

TEST(CaseCheck, ExplicitViscosityIsLimitedByTheFluidAtRest) {
  BuiltCase built = block();
  built.setup.numerics.viscous_step = ViscousStepping::explicit_step;
  built.setup.numerics.diffusion_number = 0.2;
  built.setup.fluids[0].rheology.parameters[2] = 1000;
  const CaseCheck c = check_case(built);
  EXPECT_NEAR(c.time_step, 0.2 * 965 * 0.01 * 0.01 / (0.5 + 1000 * 5), 1e-6 * c.time_step);
  EXPECT_THAT(c.time_step_reason, testing::HasSubstr("diffusion_number"));
}

TEST(CaseCheck, StrongDensityDiffusionLimitsTheTimeStep) {
  BuiltCase built = block();
  const double acoustic = built.setup.numerics.courant * 0.013 / 7;
  built.setup.numerics.density_diffusion = 0.15;
  EXPECT_NEAR(check_case(built).time_step, acoustic, 1e-12);
  built.setup.numerics.density_diffusion = 1;
  // 0.7 x 2/(delta h c0 S), S = 16.74/h^2 in 3-D.
  EXPECT_NEAR(check_case(built).time_step, 1.4 * 0.026 / (7 * 16.744), 1e-3 * acoustic);
  EXPECT_THAT(check_case(built).time_step_reason, testing::HasSubstr("density_diffusion"));
  built.setup.dimensions = 2;  // S = 16.16/h^2
  EXPECT_NEAR(check_case(built).time_step, 1.4 * 0.026 / (7 * 16.157), 1e-3 * acoustic);
}

// Measured: 2.4 to 15 times as long.
TEST(CaseCheck, ExactYieldTakesSeveralTimesAsLong) {
  BuiltCase built = block();
  const CaseCheck regularised = check_case(built);
  built.setup.numerics.yield = YieldModel::exact;
  const CaseCheck exact = check_case(built);
  EXPECT_GT(exact.run_time, 2.4 * regularised.run_time);
  EXPECT_LT(exact.run_time, 15 * regularised.run_time);
  EXPECT_THAT(to_text(exact), testing::HasSubstr("times 7 for the exact yield stress"));
  EXPECT_THAT(to_text(regularised), testing::Not(testing::HasSubstr("exact yield stress")));
}

TEST(CaseCheck, ShowsTheViscosityCorrection) {
  BuiltCase built = block();
  EXPECT_NEAR(check_case(built).viscosity_correction, 1, 0.001);
  built.setup.numerics.kernel = SmoothingKind::lucy;
  built.setup.numerics.viscous_weight = ViscousWeight::gradient;
  const CaseCheck c = check_case(built);
  EXPECT_NEAR(c.viscosity_correction, 1.047, 0.001);
  EXPECT_THAT(to_text(c), testing::HasSubstr("corrected by 1.047"));
}

TEST(CaseCheck, IsToldToProgramsToo) {
  const CaseCheck c = check_case(block());
  const Json json = to_json(c);
  EXPECT_DOUBLE_EQ(json.at("steps").number(), c.steps);
  EXPECT_DOUBLE_EQ(json.at("fluid_particles").number(), static_cast<double>(c.fluid_particles));
  EXPECT_DOUBLE_EQ(json.at("run_time").number(), c.run_time);
  for (const FluidNumbers& f : c.fluids)
    EXPECT_DOUBLE_EQ(json.at("fluids").at(f.name).at("reynolds").number(), f.reynolds);
  EXPECT_EQ(json.text().find("nan"), std::string::npos);
}

TEST(CaseCheck, TakesTheSpeedAtTheStartWhereItIsLarger) {
  BuiltCase built = block();
  built.setup.particles.velocity[3] = {0, 3, 4};
  const CaseCheck c = check_case(built);
  EXPECT_DOUBLE_EQ(c.speed, 5);
  EXPECT_EQ(c.speed_source, "largest speed at the start and from inlets");
  EXPECT_THAT(c.warnings, testing::Contains(testing::HasSubstr("Mach number")));
}

TEST(CaseCheck, HasNoNumbersWithoutAnySpeed) {
  BuiltCase built = block();
  built.setup.gravity = {0, 0, 0};
  const CaseCheck c = check_case(built);
  EXPECT_TRUE(std::isnan(c.fluids[0].reynolds));
  EXPECT_TRUE(std::isnan(c.fluids[0].dam));
  EXPECT_THAT(to_text(c), testing::HasSubstr("Reynolds -, Bingham -, N -"));
}

TEST(CaseCheck, IgnoresTheThirdDirectionInTwoDimensions) {
  BuiltCase built = block();
  built.setup.dimensions = 2;
  for (Vec3d& p : built.setup.particles.position) p.y = 0;
  EXPECT_NEAR(check_case(built).width, 0.05, 1e-12);
}

TEST(CaseCheck, PassesOnWarnings) {
  BuiltCase built = block();
  built.warnings = {"something odd"};
  EXPECT_THAT(to_text(check_case(built)), testing::HasSubstr("warning: something odd"));
}

TEST(CaseCheck, ADomainOfEmptyCellsIsTold) {
  BuiltCase built = block();
  built.setup.domain.upper = {0.2, 0.2, 0.2};
  const auto empty = testing::HasSubstr("cells without a particle");
  EXPECT_THAT(to_text(check_case(built)), testing::Not(empty));
  built.setup.domain.upper = {6, 6, 6};
  const CaseCheck check = check_case(built);
  EXPECT_THAT(to_text(check), empty);
  EXPECT_GT(check.memory, 60e7);
}

TEST(Check, RefusesWhatNeedsMoreMemoryThanThereIs) {
  const BuiltCase built = build_setup(parse_case(testing_tools::tiny_case(), "tiny.toml"));
  EXPECT_NO_THROW(require_memory(built, 1e9));
  try {
    require_memory(built, 1e5);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::MatchesRegex(
                                  "tiny.toml:4: key 'resolution.spacing': value 0.002 gives 125 fluid and "
                                  "[0-9]+ wall particles, which need about 0.00 GB of memory, 0.00 GB are "
                                  "available: allowed: .*"));
  }
}

}  // namespace
}  // namespace slagflow
