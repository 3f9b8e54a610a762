// Hydrostatic tanks, 20 mm deep: p = rho g (H - z).
#include "flows/flow.hpp"

namespace slagflow {
namespace {

constexpr double depth = 0.02;  // [m]

// Root mean square of p - rho g (H - z) over the fluid, relative to rho g H.
double pressure_error(const FluidSnapshot& s, double density) {
  double sum = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    sum += square(static_cast<double>(s.pressure[i]) - density * g * (depth - s.position[i].z));
  return std::sqrt(sum / static_cast<double>(s.position.size())) / (density * g * depth);
}

TEST(HydrostaticTank, OilKeepsPressureAndRestsForASecond) {
  Flow flow("hydrostatic_tank.toml");
  flow.run(1.0);
  const FluidSnapshot s = flow.snapshot();
  const double error = pressure_error(s, flow.setup().fluids[0].rest_density), speed = rms_speed(s);
  RecordProperty("pressure_error", std::to_string(error));
  RecordProperty("rms_speed_m_s", std::to_string(speed));
  std::printf("pressure error %.4f of rho g H, rms speed %.3g m/s\n", error, speed);
  EXPECT_LT(error, 0.03);
  EXPECT_LT(speed, 6e-4);
  EXPECT_EQ(s.position.size(), flow.setup().particles.position.size());
}

TEST(HydrostaticTank, BinghamFluidDoesNotFlow) {
  Flow flow("hydrostatic_bingham.toml");
  flow.run(1.0);
  const FluidSnapshot s = flow.snapshot();
  const double error = pressure_error(s, flow.setup().fluids[0].rest_density), speed = rms_speed(s);
  std::printf("pressure error %.4f of rho g H, rms speed %.3g m/s\n", error, speed);
  EXPECT_LT(error, 0.03);
  EXPECT_LT(speed, 1e-6);
}

}  // namespace
}  // namespace slagflow
