// Walls whose surface moves, and walls with a slip length, against closed forms.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

constexpr double gap = 0.01, speed = 0.1, density = 1000, viscosity = 0.5;  // [m] [m/s] [kg/m^3] [Pa s]
constexpr double pi = 3.14159265358979323846;

// Relative L2 error of the x velocity over the fluid.
double profile_error(const FluidSnapshot& s, const std::function<double(double)>& exact) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const double u = exact(s.position[i].z);
    error += square(static_cast<double>(s.velocity[i].x) - u);
    size += square(u);
  }
  return std::sqrt(error / size);
}

// Start from rest: the straight line less its series.
double couette(double z, double t) {
  double u = speed * z / gap;
  for (int n = 1; n < 200; ++n)
    u += 2 * speed / pi * (n % 2 ? -1 : 1) / n * std::sin(n * pi * z / gap) *
         std::exp(-square(n * pi / gap) * viscosity / density * t);
  return u;
}

TEST(WallSlip, CouetteStartUpAndStraightLine) {
  Flow flow("couette.toml");
  const double unit = gap * gap * density / viscosity;  // [s]
  for (const double t : {0.05, 0.2, 1.5}) {
    flow.run(t * unit);
    const double now = flow.simulation().time();
    const double error = profile_error(flow.snapshot(), [&](double z) { return couette(z, now); });
    std::printf("nu t/H^2 = %.2f: error %.2f %%\n", now / unit, 100 * error);
    // The start-up has a layer at the moving plate thinner than the support radius.
    EXPECT_LT(error, t < 0.1 ? 0.06 : (t < 1 ? 0.03 : 0.015));
  }
}

// Sheared by forty times its width without a pressure of its own: fluid that came under tension let go of the
// plates, 13 % off.
TEST(WallSlip, CouetteStaysRightForLong) {
  Flow flow("couette.toml", {"fluid.oil.dynamic_viscosity=0.05", "output.end_time=4"});
  flow.run(4);
  const double error = profile_error(flow.snapshot(), [](double z) { return speed * z / gap; });
  std::printf("after a shear of 40: error %.2f %%\n", 100 * error);
  EXPECT_LT(error, 0.01);
}

// u = f/(2 nu) (z (H - z) + b H)
TEST(WallSlip, PoiseuilleWithSlipLengths) {
  const double force = 4, nu = viscosity / density;
  for (const double b : {2.5e-4, 2e-3}) {
    Flow flow("poiseuille.toml", {"wall.0.slip=partial_slip", "wall.0.slip_length=" + std::to_string(b)});
    flow.run(0.3);
    const double error = profile_error(
        flow.snapshot(), [&](double z) { return force / (2 * nu) * (z * (gap - z) + b * gap); });
    std::printf("slip length %.3g H: error %.2f %%\n", b / gap, 100 * error);
    EXPECT_LT(error, 0.02);
  }
}

// u = A r + B/r between the radii a and 2a, the inner one turning at omega.
TEST(WallSlip, TurningCylinder) {
  Flow flow("cylinders.toml");
  flow.run(0.25);
  const double a = 0.01, omega = 10;
  const FluidSnapshot s = flow.snapshot();
  double error = 0, size = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const double x = s.position[i].x, z = s.position[i].z, r = std::hypot(x, z);
    const double u = omega * a / 3 * (4 * a / r - r / a);  // in the sense of omega x r: (z, -x)/r
    error += square(static_cast<double>(s.velocity[i].x) - u * z / r) +
             square(static_cast<double>(s.velocity[i].z) + u * x / r);
    size += square(u);
  }
  error = std::sqrt(error / size);
  std::printf("concentric cylinders: error %.2f %%\n", 100 * error);
  EXPECT_LT(error, 0.03);
}

}  // namespace
}  // namespace slagflow
