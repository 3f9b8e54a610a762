// Fluid that starts off its lattice sites settles, and loses pressure by it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/geometry/settling.hpp"
#include "host/geometry/setup_builder.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// A box of 15 x 15 spacings, full of oil without gravity.
Case closed_box(const std::vector<std::string>& overrides = {}) {
  return parse_case(R"([case]
name = "box"
[resolution]
spacing = 0.01
dimensions = 2
[gravity]
acceleration = [0, 0, 0]
[fluid.oil]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 1
[[region]]
jitter = 0.3
pressure = 20000
shapes = [{shape="box", min=[0,-1,0], max=[0.15,1,0.15]}]
[[wall]]
name = "vessel"
shapes = [{shape="box", min=[0,-1,0], max=[0.15,1,0.15], outside=true}]
[domain]
min = [-0.03,-1,-0.03]
max = [0.18,1,0.18]
[numerics]
sound_speed = 20
tension = "limit"
tension_limit = 0
[output]
end_time = 1
)",
                    "box.toml", overrides);
}

double mean_pressure_after(const Case& c, double time) {
  Simulation simulation(build_setup(c).setup);
  while (simulation.time() < time) simulation.step();
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  double sum = 0;
  for (const float p : snapshot.pressure) sum += static_cast<double>(p);
  return sum / static_cast<double>(snapshot.pressure.size());
}

// Roughly: from case to case it differs by a third.
TEST(Settling, LosesPressureByTheJitter) {
  const double stiffness = 1000 * 20 * 20;
  for (const auto kernel : {SmoothingKind::level, SmoothingKind::lucy})
    for (const double shifting : {0.0, 0.3, 1.0})
      for (const double jitter : {0.1, 0.2, 0.4}) {
        Case c = closed_box({"region.0.jitter=" + std::to_string(jitter), "limits.max_compression=1"});
        c.numerics.kernel = kernel;
        c.numerics.shifting = shifting;
        const double lost = (20000 - mean_pressure_after(c, 0.2)) / stiffness;
        const double told = settling_loss(c.numerics, jitter);
        EXPECT_NEAR(lost, told, 0.5 * told)
            << smoothing_names[static_cast<std::size_t>(kernel)] << " " << jitter << " " << shifting;
      }
  EXPECT_NEAR(mean_pressure_after(closed_box({"region.0.jitter=0"}), 0.2), 20000, 0.02 * 20000);
}

TEST(Settling, OfAClosedSpaceIsTold) {
  // 0.12 x 0.3 x 4e5 Pa.
  EXPECT_THAT(build_setup(closed_box({"numerics.shifting=0"})).warnings,
              Contains(testing::AllOf(HasSubstr("region 0 fills a closed space"), HasSubstr("1.4e+04 Pa"),
                                      HasSubstr("pressure = 3.44e+04"))));
  // 0.6 x 0.4 x 0.09 x 4e5 Pa.
  EXPECT_THAT(build_setup(closed_box()).warnings, Contains(HasSubstr("loses about 8.6e+03 Pa")));
  const auto told = Contains(HasSubstr("closed space"));
  for (const char* harmless :
       {"region.0.jitter=0", "region.0.jitter=0.03",
        "region.0.shapes=[{shape=\"box\", min=[0,-1,0], max=[0.15,1,0.1]}]"})  // with a free surface
    EXPECT_THAT(build_setup(closed_box({harmless})).warnings, Not(told)) << harmless;
}

// Where air cannot get in, fluid of no pressure would come under tension: it starts with some.
TEST(Settling, AClosedSpaceOfNoPressureGetsABackground) {
  const auto start = [](std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), "numerics.tension=viscous");
    const BuiltCase built = build_setup(closed_box(overrides));
    EXPECT_GE(built.resolved.numerics.background_pressure, 0);
    return built.setup.particles.pressure.front();
  };
  const std::string none = "region.0.pressure=zero", smooth = "region.0.jitter=0";
  const double stiffness = 1000 * 20 * 20;
  EXPECT_DOUBLE_EQ(start({none, smooth}), 0.01 * stiffness);
  NumericsSetup shifted;
  shifted.shifting = 1;
  EXPECT_DOUBLE_EQ(start({none}), (0.01 + settling_loss(shifted, 0.3)) * stiffness);
  EXPECT_DOUBLE_EQ(start({none, "numerics.background_pressure=7"}), 7);
  EXPECT_DOUBLE_EQ(start({"region.0.pressure=300", "numerics.background_pressure=7"}), 307);
  EXPECT_DOUBLE_EQ(start({"region.0.pressure=300"}), 300);
  EXPECT_DOUBLE_EQ(start({none, "region.0.shapes=[{shape=\"box\", min=[0,-1,0], max=[0.15,1,0.1]}]"}), 0);
  EXPECT_DOUBLE_EQ(start({none, "numerics.tension=limit"}), 0);
  EXPECT_DOUBLE_EQ(start({none, "numerics.kernel=lucy"}), 0);
}

TEST(Settling, ShiftsParticlesOfAClosedSpaceAlone) {
  const auto shifting = [](std::vector<std::string> overrides) {
    return build_setup(closed_box(overrides)).setup.numerics.shifting;
  };
  EXPECT_EQ(shifting({}), 1);
  EXPECT_EQ(shifting({"numerics.shifting=0.3"}), 0.3);
  EXPECT_EQ(shifting({"numerics.kernel=lucy"}), 0);
  EXPECT_EQ(shifting({"fluid.oil.surface_tension=0.02"}), 0);
  EXPECT_EQ(shifting({"region.0.shapes=[{shape=\"box\", min=[0,-1,0], max=[0.15,1,0.1]}]"}), 0);
}

}  // namespace
}  // namespace slagflow
