// The whole step: bookkeeping, repeatability and errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "core/simulation_setups.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;
using testing::HasSubstr;

void advance(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
}

FluidSnapshot read(Simulation& simulation) {
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  return snapshot;
}

std::int64_t sum_of(const std::array<std::int64_t, 6>& counts) {
  std::int64_t total = 0;
  for (std::int64_t n : counts) total += n;
  return total;
}

template <class T>
void expect_same_bits(const std::vector<T>& a, const std::vector<T>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  if (!a.empty()) {
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0) << what;
  }
}

void expect_same_bits(const FluidSnapshot& a, const FluidSnapshot& b) {
  EXPECT_EQ(a.time, b.time);
  expect_same_bits(a.position, b.position, "position"), expect_same_bits(a.velocity, b.velocity, "velocity");
  expect_same_bits(a.pressure, b.pressure, "pressure"), expect_same_bits(a.density, b.density, "density");
  expect_same_bits(a.viscosity, b.viscosity, "viscosity"),
      expect_same_bits(a.shear_rate, b.shear_rate, "shear rate");
  expect_same_bits(a.shear_stress, b.shear_stress, "shear stress");
  expect_same_bits(a.thickness, b.thickness, "sheet thickness");
  expect_same_bits(a.yielded, b.yielded, "yielded"), expect_same_bits(a.fluid, b.fluid, "fluid");
  expect_same_bits(a.id, b.id, "id");
}

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

constexpr int dam_steps = 90;

TEST(Simulation, CountsAndMassesAddUpAtEveryStep) {
  const SimulationSetup setup = dam();
  Simulation simulation(setup);
  const double mass_start = 147 * (2600 + 900) * 1e-6;
  for (int k = 0; k < dam_steps; ++k) {
    simulation.step();
    const Totals t = simulation.totals();
    ASSERT_EQ(t.particles + sum_of(t.departed), 294);
    ASSERT_NEAR(t.mass_start, mass_start, 1e-7 * mass_start);  // a particle's mass has 24 bits
    ASSERT_DOUBLE_EQ(t.mass_in + t.mass_left, t.mass_start);
    ASSERT_EQ(static_cast<std::int64_t>(read(simulation).id.size()), t.particles);
  }
  const Totals t = simulation.totals();
  EXPECT_GT(sum_of(t.departed), 10) << "nothing left: nothing is tested";
  EXPECT_EQ(t.departed[2] + t.departed[3], 0) << "through periodic faces";
  EXPECT_GT(t.particles, 100);
  EXPECT_EQ(simulation.steps(), dam_steps);
  EXPECT_EQ(simulation.solver_totals().steps, dam_steps);
  EXPECT_EQ(simulation.solver_totals().retried, 0);
  EXPECT_GT(simulation.list_builds(), 1);
  EXPECT_LT(simulation.list_builds(), dam_steps);
}

TEST(Simulation, SnapshotsAreOrderedByIdAndPlausible) {
  Simulation simulation(dam());
  advance(simulation, dam_steps);
  const FluidSnapshot s = read(simulation);
  EXPECT_EQ(s.time, simulation.time());
  EXPECT_TRUE(std::is_sorted(s.id.begin(), s.id.end()));
  EXPECT_EQ(std::adjacent_find(s.id.begin(), s.id.end()), s.id.end());
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const bool is_slag = s.id[i] < 147;
    EXPECT_EQ(s.fluid[i], is_slag ? 0 : 1) << s.id[i];
    EXPECT_NEAR(static_cast<double>(s.density[i]), is_slag ? 2600 : 900, is_slag ? 800 : 300);
    EXPECT_GE(s.shear_rate[i], 0);
    EXPECT_GE(s.pressure[i], -8.001 * s.viscosity[i] * s.shear_rate[i]);
    EXPECT_NEAR(static_cast<double>(s.viscosity[i]),
                static_cast<double>(viscosity(is_slag ? slag().rheology : oil().rheology,
                                              static_cast<Real>(s.shear_rate[i]))),
                1e-4 * static_cast<double>(s.viscosity[i]));
    EXPECT_EQ(
        s.yielded[i],
        yielded(is_slag ? slag().rheology : oil().rheology, static_cast<Real>(s.shear_stress[i])) ? 1 : 0);
  }
}

TEST(Simulation, StartsFromTheSetup) {
  const SimulationSetup setup = dam();
  Simulation simulation(setup);
  const FluidSnapshot s = read(simulation);
  ASSERT_EQ(s.id.size(), setup.particles.position.size());
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    EXPECT_EQ(s.id[i], static_cast<std::int64_t>(i));
    EXPECT_LT(norm(s.position[i] - setup.particles.position[i]), 1e-15);
    EXPECT_NEAR(static_cast<double>(s.velocity[i].x), 0.6, 1e-7);
    EXPECT_NEAR(static_cast<double>(s.pressure[i]), setup.particles.pressure[i], 1e-6 * 1000);
    const double rest = setup.fluids[s.fluid[i]].rest_density;
    EXPECT_NEAR(static_cast<double>(s.density[i]), rest + setup.particles.pressure[i] / 16, 1e-6 * rest);
  }
  EXPECT_EQ(simulation.time(), 0);
  EXPECT_EQ(simulation.steps(), 0);
  EXPECT_NEAR(simulation.time_step(), 0.5 * 1.3 * dx / 4, 1e-12);
  EXPECT_GT(simulation.device_bytes(), 294U * 100);
}

TEST(Simulation, TotalsMatchTheSnapshot) {
  Simulation simulation(dam());
  advance(simulation, 20);
  const Totals t = simulation.totals();
  const FluidSnapshot s = read(simulation);
  double kinetic = 0, potential = 0, fastest = 0;
  Vec3d momentum, angular, beyond;
  std::int64_t passed = 0;
  double lead = -1;
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const double mass = (s.fluid[i] == 0 ? 2600 : 900) * 1e-6;
    const Vec3d v = to_double(s.velocity[i]), x = s.position[i];
    kinetic += 0.5 * mass * dot(v, v), potential += mass * 9.81 * x.z, fastest = std::max(fastest, norm(v));
    momentum += mass * v, angular += mass * cross(x, v), lead = std::max(lead, x.x);
    if (x.x > 0.05) beyond += x, ++passed;
  }
  EXPECT_NEAR(t.kinetic_energy, kinetic, 1e-6 * kinetic);
  EXPECT_NEAR(t.potential_energy, potential, 1e-6 * std::fabs(potential));
  EXPECT_NEAR(t.max_speed, fastest, 1e-6 * fastest);
  EXPECT_LT(norm(t.momentum - momentum), 1e-6 * norm(momentum));
  EXPECT_LT(norm(t.angular_momentum - angular), 1e-6 * norm(angular));
  ASSERT_EQ(t.fronts.size(), 2U);
  EXPECT_EQ(t.fronts[0].passed, passed + t.departed[1]);
  EXPECT_NEAR(t.fronts[0].extreme, lead, 1e-7);
  EXPECT_LT(norm(t.fronts[0].mean_position - 1.0 / static_cast<double>(passed) * beyond), 1e-9);
}

TEST(Simulation, RepeatsToTheBitWithAnyNumberOfThreads) {
  const int threads = device_info().threads;
  std::vector<FluidSnapshot> runs;
  for (int n : {2, 2, 1}) {
    set_threads(n);
    Simulation simulation(dam());
    advance(simulation, dam_steps);
    runs.push_back(read(simulation));
  }
  set_threads(threads);
  expect_same_bits(runs[0], runs[1]);
  expect_same_bits(runs[0], runs[2]);
}

TEST(Simulation, RepeatsToTheBitWithEverySolver) {
  for (ViscousSolver solver : {ViscousSolver::sor, ViscousSolver::jacobi}) {
    SimulationSetup setup = dam();
    setup.numerics.solver = solver, setup.numerics.max_iterations = 2000;
    Simulation one(setup), two(setup);
    advance(one, 20), advance(two, 20);
    expect_same_bits(read(one), read(two));
  }
}

TEST(Simulation, SolversAgree) {
  SimulationSetup setup = dam();
  setup.numerics.tolerance = 1e-3, setup.numerics.max_iterations = 4000;
  Simulation reference_run(setup);
  advance(reference_run, 20);
  const FluidSnapshot wanted = read(reference_run);
  for (ViscousSolver solver : {ViscousSolver::sor, ViscousSolver::jacobi}) {
    setup.numerics.solver = solver;
    Simulation simulation(setup);
    advance(simulation, 20);
    const FluidSnapshot s = read(simulation);
    ASSERT_EQ(s.id, wanted.id);
    for (std::size_t i = 0; i < s.id.size(); ++i)
      EXPECT_LT(norm(s.position[i] - wanted.position[i]), 0.01 * dx);
  }
}

TEST(Simulation, RestoredGoesOnToTheSameBits) {
  Simulation whole(dam());
  advance(whole, 25);
  const SavedState saved = whole.save();
  Simulation restored(dam());
  restored.restore(saved);
  EXPECT_EQ(restored.time(), whole.time());
  EXPECT_EQ(restored.steps(), 25);
  expect_same_bits(read(restored), read(whole));
  advance(whole, 35), advance(restored, 35);
  expect_same_bits(read(restored), read(whole));
  const Totals a = whole.totals(), b = restored.totals();
  EXPECT_EQ(a.departed, b.departed);
  EXPECT_EQ(a.dissipated_energy, b.dissipated_energy);
  EXPECT_EQ(a.mass_left, b.mass_left);
  EXPECT_EQ(whole.list_builds(), restored.list_builds());
  EXPECT_EQ(whole.solver_totals().iterations, restored.solver_totals().iterations);
}

TEST(Simulation, RestoreRefusesAStateOfAnotherCase) {
  Simulation one(dam()), other(tank(oil()));
  EXPECT_THAT(error_of([&] { other.restore(one.save()); }), HasSubstr("checkpoint"));
  SavedState part = one.save();
  part.erase(part.begin());
  EXPECT_THAT(error_of([&] { one.restore(part); }), HasSubstr("missing"));
}

// Each would otherwise be taken as an index, or keep a run from ending.
TEST(Simulation, RestoreRefusesWhatNoRunCanHave) {
  Simulation simulation(dam());
  advance(simulation, 3);
  const SavedState sound = simulation.save();
  const auto error_with = [&](const char* name, std::size_t byte, int value) {
    SavedState state = sound;
    for (SavedArray& array : state)
      if (array.name == name) array.bytes.at(byte) = static_cast<std::byte>(value);
    return error_of([&] { simulation.restore(state); });
  };
  EXPECT_THAT(error_with("fluid", 5, 2), HasSubstr("is of fluid 2, the case has 2"));
  EXPECT_THAT(error_with("id", 7, 0xff), HasSubstr("not in order"));
  EXPECT_THAT(error_with("list_places", 3, 0x7f), HasSubstr("not in order"));
  EXPECT_THAT(error_with("numbers", 7, 0xff), HasSubstr("not those of a run"));   // time
  EXPECT_THAT(error_with("numbers", 15, 0xff), HasSubstr("not those of a run"));  // time step
  EXPECT_EQ(error_of([&] { simulation.restore(sound); }), "no error");
}

TEST(Simulation, NotANumberNamesTheParticle) {
  for (std::size_t bad : {std::size_t(0), std::size_t(57), std::size_t(293)}) {
    SimulationSetup setup = dam();
    setup.particles.velocity[bad].z = std::nan("");
    const std::string message = error_of([&] {
      Simulation simulation(setup);
      advance(simulation, 5);
    });
    EXPECT_THAT(message, HasSubstr("not a number"));
    EXPECT_THAT(message, HasSubstr("particle " + std::to_string(bad) + " "));
  }
}

TEST(Simulation, DepartureStopRaisesAnError) {
  SimulationSetup setup = dam();
  setup.domain.departure = Departure::stop;
  const std::string message = error_of([&] {
    Simulation simulation(setup);
    advance(simulation, 200);
  });
  EXPECT_THAT(message, HasSubstr("left the domain"));
  EXPECT_THAT(message, testing::AnyOf(HasSubstr("+x"), HasSubstr("-z")));
}

TEST(Simulation, AnUnconvergedSolveRaisesAnError) {
  SimulationSetup setup = dam();
  setup.numerics.max_iterations = 1, setup.numerics.tolerance = 1e-6;
  const std::string message = error_of([&] {
    Simulation simulation(setup);
    advance(simulation, 3);
  });
  EXPECT_THAT(message, HasSubstr("did not converge"));
  EXPECT_THAT(message, HasSubstr("max_iterations"));
}

TEST(Simulation, ImpossibleInputIsRefused) {
  auto error_with = [](const std::function<void(SimulationSetup&)>& change) {
    SimulationSetup setup = dam();
    change(setup);
    return error_of([&] { Simulation simulation(setup); });
  };
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.spacing = 0; }), HasSubstr("spacing"));
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.dimensions = 4; }), HasSubstr("dimensions"));
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.numerics.sound_speed = -1; }), HasSubstr("sound_speed"));
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.numerics.theta = 0; }), HasSubstr("theta"));
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.particles.velocity.pop_back(); }), HasSubstr("length"));
  EXPECT_THAT(error_with([](SimulationSetup& s) { s.domain.upper.y = s.domain.lower.y + 0.05; }),
              HasSubstr("axis y"));
}

TEST(Simulation, WithoutParticlesRuns) {
  SimulationSetup setup = dam();
  setup.particles = {};
  Simulation simulation(setup);
  advance(simulation, 12);
  EXPECT_EQ(simulation.steps(), 12);
  EXPECT_GT(simulation.time(), 0);
  EXPECT_EQ(simulation.totals().particles, 0);
  EXPECT_EQ(simulation.totals().mass_in, 0);
  EXPECT_TRUE(read(simulation).id.empty());
  EXPECT_EQ(simulation.neighbours_mean(), 0);
}

TEST(Simulation, GoesOnWhenAllParticlesHaveLeft) {
  SimulationSetup setup = empty_setup({0, 0, 0}, {0.2, 0.2, 0.2});
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        add_particle(setup, {0.18 + 0.009 * i, 0.1 + dx * j, 0.1 + dx * k}, {3, 0, 0}, i == 1 ? 1 : 0);
  Simulation simulation(setup);
  advance(simulation, 60);
  const Totals t = simulation.totals();
  EXPECT_EQ(t.particles, 0);
  EXPECT_EQ(t.departed[1], 27);
  EXPECT_NEAR(t.mass_left, t.mass_start, 1e-15);
  EXPECT_TRUE(read(simulation).position.empty());
}

TEST(Simulation, SolveThatDoesNotConvergeIsRetriedWithASmallerStep) {
  SimulationSetup setup = dam();
  setup.numerics.solver = ViscousSolver::conjugate_gradient;
  setup.numerics.tension = TensionModel::limit;  // else densities stop at what the stress holds
  Simulation smooth(setup);
  smooth.step();
  const int needed = smooth.last_solve().iterations;
  ASSERT_GT(needed, 4);
  setup.numerics.max_iterations = needed / 2;
  Simulation simulation(setup);
  const double full = simulation.time_step();
  simulation.step();
  EXPECT_GE(simulation.solver_totals().retried, 1);
  EXPECT_TRUE(simulation.last_solve().converged);
  EXPECT_LT(simulation.time_step(), 0.6 * full);
  EXPECT_DOUBLE_EQ(simulation.time(), simulation.time_step());
  // The density follows what the particles have moved: a step later all is as after short steps.
  const double quarter = simulation.time_step();
  simulation.step();
  EXPECT_DOUBLE_EQ(simulation.time(), full + quarter);
  const double moved_until = simulation.time();
  simulation.step();
  setup.numerics.max_time_step = quarter;
  Simulation fine(setup), at_start(setup);
  while (fine.time() < moved_until + quarter / 2) fine.step();
  ASSERT_EQ(fine.solver_totals().retried, 0);
  const FluidSnapshot before = read(at_start), a = read(simulation), b = read(fine);
  double product = 0, weight = 0;
  for (std::size_t i = 0; i < a.density.size(); ++i) {
    const double wanted = static_cast<double>(b.density[i] - before.density[i]);
    product += wanted * static_cast<double>(a.density[i] - before.density[i]), weight += wanted * wanted;
  }
  ASSERT_GT(weight, 0);
  EXPECT_NEAR(product / weight, 1, 0.1);  // first order in a step of half the acoustic limit
}

TEST(Simulation, ExplicitViscosityTakesTheTimeStepOfItsLimit) {
  SimulationSetup setup = dam();
  setup.numerics.viscous_step = ViscousStepping::explicit_step;
  setup.numerics.diffusion_number = 0.05;
  Simulation simulation(setup);
  simulation.step();
  // The stiffest particle at rest: eta = eta_P + m tau_B, over its density.
  double largest = 0;
  for (const auto& fluid : setup.fluids)
    largest = std::max(largest, static_cast<double>(viscosity(fluid.rheology, 0)) / fluid.rest_density);
  EXPECT_NEAR(simulation.time_step(), 0.05 * setup.spacing * setup.spacing / largest,
              0.02 * simulation.time_step());
  EXPECT_EQ(simulation.last_solve().iterations, 0);
}

}  // namespace
}  // namespace slagflow
