// Forces on walls at rest, and walls that move: nothing passes them.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

Vec3d force_of(const Totals& begin, const Totals& end, std::size_t wall, double seconds) {
  const WallLoad &a = begin.walls.at(wall), &b = end.walls.at(wall);
  return (b.pressure + b.viscous - a.pressure - a.viscous) * (1 / seconds);
}

TEST(WallForces, AGateHoldsAColumnAndTheTankItsWeight) {
  Flow flow("gate_column.toml");
  flow.run(0.5);
  const Totals begin = flow.simulation().totals();
  const double start = flow.simulation().time();
  flow.run(1.0);
  const Totals end = flow.simulation().totals();
  const double seconds = flow.simulation().time() - start, density = 965, depth = 0.02, width = 0.0125;
  const Vec3d tank = force_of(begin, end, 0, seconds), gate = force_of(begin, end, 1, seconds);
  const double head = 0.5 * density * g * depth * depth, weight = density * g * depth * width;
  std::printf("gate %.4f of rho g H^2/2, tank %.4f of the weight, sides differ by %.2g\n", gate.x / head,
              -(tank.z + gate.z) / weight, (gate.x + tank.x) / head);
  EXPECT_NEAR(gate.x / head, 1, 0.03);
  EXPECT_NEAR(-(tank.z + gate.z) / weight, 1, 0.01);
  EXPECT_NEAR((gate.x + tank.x) / head, 0, 0.005);  // at rest the sides bear the same
}

// Depth of the deepest particle behind planes [spacings].
double deepest(const FluidSnapshot& s, double spacing, const std::function<double(Vec3d)>& depth) {
  double worst = -1e30;
  for (const Vec3d& x : s.position) worst = std::max(worst, depth(x) / spacing);
  return worst;
}

TEST(MovingWalls, NothingPassesAPiston) {
  Flow flow("piston.toml");
  const double spacing = flow.setup().spacing, speed = 0.05;
  const std::size_t particles = flow.snapshot().position.size();
  double worst = -1e30;
  flow.run(0.5, [&] {
    const double face = speed * std::min(flow.simulation().time(), 0.2);
    worst = std::max(worst, deepest(flow.snapshot(), spacing, [&](Vec3d x) {
                       return std::max({face - x.x, x.x - 0.025, -x.y, x.y - 0.0125, -x.z});
                     }));
    return false;
  });
  const FluidSnapshot s = flow.snapshot();
  double mean = 0;  // height: half the level
  for (const Vec3d& x : s.position) mean += x.z / static_cast<double>(s.position.size());
  const double level = 0.01 * 25 / 15;
  std::printf("deepest particle %.2f spacings in a wall, mean height %.4f of half the level\n", worst,
              mean / (0.5 * level));
  EXPECT_EQ(s.position.size(), particles);
  EXPECT_LT(worst, 0.6);
  EXPECT_NEAR(mean / (0.5 * level), 1, 0.03);  // the volume is kept
}

// Closed for 0.1 s, then lifting: nothing is beyond it while it is closed, nothing in it at any time.
TEST(MovingWalls, AGateHoldsAndOpens) {
  Flow flow("dam_discharge_gate.toml", {"wall.1.motion.start=0.1", "wall.1.motion.stop=0.3"});
  const double spacing = flow.setup().spacing;
  double beyond = -1e30, inside = -1e30;
  flow.run(0.45, [&] {
    const double time = flow.simulation().time(), bottom = 0.2 * std::max(0.0, std::min(time, 0.3) - 0.1);
    const FluidSnapshot s = flow.snapshot();
    if (time < 0.1) beyond = std::max(beyond, deepest(s, spacing, [](Vec3d x) { return x.x; }));
    inside = std::max(inside, deepest(s, spacing, [&](Vec3d x) {
                        return std::min({x.x, 0.01 - x.x, x.z - bottom, bottom + 0.03 - x.z});
                      }));
    return false;
  });
  std::printf("closed: at most %.2f spacings into the gate; lifting: %.2f\n", beyond, inside);
  EXPECT_LT(beyond, 0.6);
  EXPECT_LT(inside, 0.6);
  EXPECT_GT(flow.simulation().totals().fronts[0].passed, 0);
}

// Least squares: pressure = mean + slope.(x - mean place), and the rms of what is left.
struct LinearPressure {
  double mean = 0, along = 0, up = 0, rest = 0;

  explicit LinearPressure(const FluidSnapshot& s) {
    const auto n = static_cast<double>(s.position.size());
    double x0 = 0, z0 = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i)
      mean += static_cast<double>(s.pressure[i]) / n, x0 += s.position[i].x / n, z0 += s.position[i].z / n;
    double xx = 0, xz = 0, zz = 0, xp = 0, zp = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      const double x = s.position[i].x - x0, z = s.position[i].z - z0;
      const double p = static_cast<double>(s.pressure[i]) - mean;
      xx += x * x, xz += x * z, zz += z * z, xp += x * p, zp += z * p;
    }
    along = (xp * zz - zp * xz) / (xx * zz - xz * xz), up = (zp * xx - xp * xz) / (xx * zz - xz * xz);
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      const double linear = mean + along * (s.position[i].x - x0) + up * (s.position[i].z - z0);
      rest += square(static_cast<double>(s.pressure[i]) - linear) / n;
    }
    rest = std::sqrt(rest);
  }
};

// Pressure of the effective gravity; the walls push with mass times acceleration and bear the weight.
TEST(MovingWalls, OilInABoxThatAcceleratesHasTheEffectiveGravity) {
  Flow flow("verification/accelerated_box.toml");
  const double density = 1000, side = 0.02, mass = density * side * side, a = 5;
  flow.run(0.06);
  const Totals begin = flow.simulation().totals();
  const double start = flow.simulation().time();
  flow.run(0.1);
  const Vec3d force = force_of(begin, flow.simulation().totals(), 0, flow.simulation().time() - start);
  const LinearPressure p(flow.snapshot());
  std::printf(
      "force %.4f of -m a, %.4f of the weight; slopes %.4f and %.4f of rho (a, g), rest %.4f of rho a L\n",
      force.x / (-mass * a), -force.z / (mass * g), p.along / (-density * a), -p.up / (density * g),
      p.rest / (density * a * side));
  EXPECT_NEAR(force.x / (-mass * a), 1, 0.03);
  EXPECT_NEAR(-force.z / (mass * g), 1, 0.03);
  EXPECT_NEAR(p.along / (-density * a), 1, 0.03);
  EXPECT_NEAR(-p.up / (density * g), 1, 0.03);
  EXPECT_LT(p.rest / (density * a * side), 0.03);
}

// A crust of 1e6 Pa s keeps to the roll that it sits on, and its density: nothing shears it.
TEST(MovingWalls, ARollCarriesItsCrustAlong) {
  Flow flow("verification/ring_on_roll.toml");
  const FluidSnapshot before = flow.snapshot();
  flow.run(0.3);
  const FluidSnapshot after = flow.snapshot();
  const double turn = 1.5 * flow.simulation().time();
  for (std::size_t i = 0; i < before.id.size(); ++i) {
    const Vec3d &a = before.position[i], &b = after.position[i];
    const double along = a.x * std::cos(turn) + a.z * std::sin(turn),
                 up = a.z * std::cos(turn) - a.x * std::sin(turn);
    EXPECT_NEAR(b.x, along, 2e-5) << i;
    EXPECT_NEAR(b.z, up, 2e-5) << i;
  }
  EXPECT_LT(flow.simulation().largest_compression().value, 1e-3);
}

}  // namespace
}  // namespace slagflow
