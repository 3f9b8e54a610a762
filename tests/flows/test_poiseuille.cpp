// Plane Poiseuille flow against closed forms: half gap a, G = rho f, wall stress G a.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

constexpr double gap = 0.01, density = 1000, viscosity = 0.5, force = 4;  // [m] [kg/m^3] [Pa s] [m/s^2]
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

// Start from rest: parabola less its series.
double newtonian(double z, double t) {
  const double nu = viscosity / density;
  double u = force * z * (gap - z) / (2 * nu);
  for (int n = 0; n < 50; ++n) {
    const double k = (2 * n + 1) * pi;
    u -= 4 * force * gap * gap / (nu * k * k * k) * std::sin(k * z / gap) *
         std::exp(-k * k * nu * t / (gap * gap));
  }
  return u;
}

// Steady flow of the regularised fluid, exact in the shear rate: G y = eta_P gamma + tau_B (1 - e^{-m
// gamma}).
struct Papanastasiou {
  double yield_stress, m;

  double stress(double rate) const { return viscosity * rate - yield_stress * std::expm1(-m * rate); }
  double rate_at(double stress_wanted) const {
    double low = 0, high = stress_wanted / viscosity;
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (low + high);
      (stress(middle) < stress_wanted ? low : high) = middle;
    }
    return low;
  }
  double velocity(double z) const {
    const double drive = density * force, y = std::abs(z - 0.5 * gap);
    const double here = rate_at(drive * y), wall = rate_at(drive * 0.5 * gap);
    const auto part = [&](double rate) { return std::exp(-m * rate) * (1 + m * rate); };
    return (0.5 * viscosity * (wall * wall - here * here) + yield_stress / m * (part(here) - part(wall))) /
           drive;
  }
};

TEST(Poiseuille, NewtonianStartUpAndParabola) {
  Flow flow("poiseuille.toml");
  const double unit = gap * gap * density / viscosity;  // [s]
  for (const double t : {0.05, 0.2, 1.5}) {
    flow.run(t * unit);
    const double now = flow.simulation().time();
    const double error = profile_error(flow.snapshot(), [&](double z) { return newtonian(z, now); });
    std::printf("nu t/H^2 = %.2f: error %.2f %%\n", now / unit, 100 * error);
    // The start-up has the walls' diffusion layers thinner than the support radius.
    EXPECT_LT(error, t < 0.1 ? 0.04 : (t < 1 ? 0.02 : 0.015));
  }
}

// The steady flow dissipates the work of the force: the wall pairs' share of the shear rate is all of theirs.
TEST(Poiseuille, DissipatesTheWorkOfTheForce) {
  Flow flow("poiseuille.toml");
  Simulation& simulation = flow.simulation();
  flow.run(0.2);
  const double before = simulation.totals().dissipated_energy;
  double work = 0;
  while (simulation.time() < 0.25) {
    const double then = simulation.time();
    simulation.step();
    work += force * simulation.totals().momentum.x * (simulation.time() - then);
  }
  const double ratio = (simulation.totals().dissipated_energy - before) / work;
  std::printf("dissipated / work %.4f\n", ratio);
  // Measured 0.999; without half of the wall pairs it was 0.915.
  EXPECT_NEAR(ratio, 1, 0.015);
}

TEST(Poiseuille, BinghamPlugAndShearedLayers) {
  Flow flow("poiseuille_bingham.toml");
  flow.run(0.3);
  const Papanastasiou exact{8, 1000};
  const double error = profile_error(flow.snapshot(), [&](double z) { return exact.velocity(z); });
  std::printf("error against the Papanastasiou profile %.2f %%\n", 100 * error);
  EXPECT_LT(error, 0.03);  // measured 1.5 %
}

// A wall stress of 20 Pa below a yield stress of 25 Pa: only the creep of the regularisation, whose speed in
// the middle is G a^2 / 2 (eta_P + m tau_B) to within 1 % here.
TEST(Poiseuille, BelowYieldOnlyTheRegularisationCreeps) {
  Flow flow("poiseuille_bingham.toml", {"fluid.slurry.yield_stress=25"});
  flow.run(0.1);
  const Papanastasiou exact{25, 1000};
  double fastest = 0;
  for (const auto& v : flow.snapshot().velocity) fastest = std::max(fastest, static_cast<double>(v.x));
  std::printf("creep %.3g m/s, regularised %.3g m/s\n", fastest, exact.velocity(0.5 * gap));
  EXPECT_NEAR(fastest / exact.velocity(0.5 * gap), 1, 0.1);
}

}  // namespace
}  // namespace slagflow
