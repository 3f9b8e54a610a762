// The first sweep: density, equation of state, shear rate and viscosity against the oracle.
#include <gtest/gtest.h>

#include "core/scene.hpp"
#include "reference_contact.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

// Rounding: a sum of about 100 terms, each of some ten operations.
constexpr double rounding = 40 * epsilon;

class Density : public testing::TestWithParam<SceneOptions> {
 protected:
  Density() : scene_(GetParam()), scratch_(scene_.context, "scratch") {}

  void advance(double dt) {
    scene_.upload();
    update_density(scene_.context, scene_.pairs(), scene_.fluid, scratch_, static_cast<Real>(dt));
    motion_ = scene_.by_id(view(scene_.fluid).motion), state_ = scene_.by_id(view(scene_.fluid).state);
    place_ = scene_.by_id(view(scene_.fluid).place), pressure_ = scene_.by_id(view(scene_.fluid).pressure);
    shear_rate_ = scene_.by_id(Span<const Real>(scene_.fluid.shear_rate.span()));
  }

  double viscosity(std::size_t i) const {
    return static_cast<double>(reference::viscosity(scene_.world.kind(scene_.world.particles[i]),
                                                    static_cast<long double>(shear_rate_[i])));
  }
  // The tension [Pa] that its viscous stress lets particle i bear.
  double tension_limit(std::size_t i) const {
    return std::min(scene_.world.tension_limit, 8 * viscosity(i) * static_cast<double>(shear_rate_[i]));
  }

  // Of the step of dt that was made: no density falls below what the tension holds, and what is beyond is
  // kept.
  void expect_changes(double dt) {
    const std::vector<Real> hollow = scene_.by_id(Span<const Real>(scene_.fluid.hollow.span()));
    int voids = 0;
    for (std::size_t i = 0; i < motion_.size(); ++i) {
      const auto& p = scene_.world.particles[i];
      const reference::Sum change = reference::density_change(scene_.world, i, dt);
      const double left = reference::hollow_left(scene_.world, i, dt), now = p.excess - left + change.value.x;
      // Over a void tension grows by expansion alone.
      const double stretched = left > 0 ? std::min(now + left, p.excess) : now;
      const double limit = -tension_limit(i) / square(scene_.world.sound_speed),
                   least = std::max(stretched, limit);
      const double error = rounding * (change.size - limit) + 2 * epsilon * (std::fabs(p.excess) + p.hollow) +
                           (p.hollow > 0 ? rounding * scene_.world.kind(p).rest_density : 0);
      voids += now < least;
      EXPECT_NEAR(static_cast<double>(motion_[i].w), std::max(now, least), error) << "particle " << i;
      EXPECT_NEAR(static_cast<double>(hollow[i]), std::max(now, least) - now, error) << "particle " << i;
    }
    EXPECT_GT(voids, 5);
    EXPECT_LT(voids, static_cast<int>(motion_.size()) * 3 / 4);
  }

  void let_walls_move() {
    Random random(3);
    for (auto& wall : scene_.world.walls) {
      const Vec3d a = random.vector(200), s = random.vector(0.05 * Scene::spacing);
      wall.acceleration = {a.x, a.y, a.z}, wall.moved = {s.x, s.y, s.z};
    }
    scene_.walls_move = true;
  }

  Scene scene_;
  Buffer<Real> scratch_;
  std::vector<Quad> motion_, state_, place_;
  std::vector<Real> pressure_, shear_rate_;
};

TEST_P(Density, ChangeMatchesOracle) {
  advance(1e-3);
  expect_changes(1e-3);
}

// Up to a third of the volume: of some more than the places leave room for.
TEST_P(Density, ClosesVoidsBeforeItRises) {
  int closed = 0, open = 0;
  for (std::size_t i = 0; i < scene_.world.particles.size(); ++i) {
    auto& p = scene_.world.particles[i];
    p.hollow = i % 2 == 0 ? 0 : 300.0 * static_cast<double>(i % 5);
    if (i % 5 != 1) continue;
    const double left = reference::hollow_left(scene_.world, i, 1e-3);
    closed += p.hollow > 0 && left<p.hollow, open += left> 0;
  }
  EXPECT_GT(closed, 0);
  EXPECT_GT(open, 0);
  advance(1e-3);
  expect_changes(1e-3);
}

// A step later a particle is up to a twentieth of a spacing further: what the sums half-way are for.
TEST_P(Density, ChangeMatchesOracleWhereWallsMove) {
  let_walls_move();
  advance(1e-3);
  expect_changes(1e-3);
}

// A wall particle at its own limit has no density to diffuse towards.
TEST_P(Density, ChangeMatchesOracleWhereWallsHaveLimits) {
  scene_.give_walls_limits();
  advance(1e-3);
  expect_changes(1e-3);
}

TEST_P(Density, ShearRateMatchesOracle) {
  for (auto& wall : scene_.world.walls) wall.v = {0.2, 0, -0.1};
  let_walls_move();
  advance(1e-3);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const reference::Sum squared = reference::shear_rate_squared(scene_.world, i, 1e-3);
    EXPECT_NEAR(square(static_cast<double>(shear_rate_[i])), squared.value.x, rounding * squared.size)
        << "particle " << i;
  }
}

// Particles that a wall should have stopped, at all depths.
TEST_P(Density, ContactMatchesOracle) {
  if (scene_.world.walls.empty()) GTEST_SKIP() << "no walls";
  for (auto& w : scene_.world.walls)
    w.x = w.x + reference::Vec{1.7 * Scene::spacing, 0, 1.7 * Scene::spacing};
  advance(1e-3);
  const std::vector<Real> contact = scene_.by_id(Span<const Real>(scene_.fluid.contact.span()));
  int touching = 0;
  for (std::size_t i = 0; i < contact.size(); ++i) {
    const double wanted = reference::contact_pressure(scene_.world, i);
    touching += wanted > 0;
    const double scale = wanted > 0 ? 2600 * 49.0 : 1e30;
    EXPECT_NEAR(static_cast<double>(contact[i]), wanted, 20 * epsilon * scale) << "particle " << i;
  }
  EXPECT_GT(touching, 5);
}

// A block of wall particles with its edge at x = z = 5 spacings, each with the normal of the face nearest to
// it; the one at the edge with that of the one or the other. A particle is as deep as below the nearer face.
TEST(Contact, AtAConvexEdgeIsThatOfTheNearestFace) {
  struct Place {
    double x, z, depth;  // from the edge [spacings]; depth 0: none
  };
  const Place places[] = {{-0.4, -0.1, 0.1}, {-0.1, -0.4, 0.1}, {-0.3, -0.3, 0.3}, {-0.05, -0.45, 0.05},
                          {0.2, -0.4, 0},    {-0.4, 0.2, 0},    {-1.2, -0.2, 0.2}, {0.1, 0.1, 0}};
  for (const bool sideways : {false, true})
    for (const Place& at : places) {
      Scene scene({2, Surroundings::free, 10, 0, 1});
      const double dx = Scene::spacing, edge = 5 * dx;
      auto p = scene.world.particles[0];
      p.x = {edge + at.x * dx, dx / 2, edge + at.z * dx};
      scene.world.particles = {p};
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
          reference::Wall w;
          w.x = {edge - (i + 0.5) * dx, dx / 2, edge - (k + 0.5) * dx};
          const bool side = i < k || (i == k && sideways);
          w.normal = side ? reference::Vec{1, 0, 0} : reference::Vec{0, 0, 1};
          w.depth = (side ? i + 0.5 : k + 0.5) * dx;
          scene.world.walls.push_back(w);
        }
      scene.upload();
      Buffer<Real> scratch(scene.context, "scratch");
      update_density(scene.context, scene.pairs(), scene.fluid, scratch, 0);
      const double contact =
          static_cast<double>(scene.by_id(Span<const Real>(scene.fluid.contact.span()))[0]);
      const double stiffness = scene.world.kind(p).rest_density * square(scene.world.sound_speed);
      EXPECT_NEAR(contact, at.depth > 0 ? stiffness * at.depth : -1e30,
                  at.depth > 0 ? 1e-4 * stiffness : 1e24)
          << at.x << ", " << at.z;
    }
}

TEST_P(Density, StateFollowsFromDensityAndShearRate) {
  for (std::size_t i = 0; i < scene_.world.particles.size(); ++i)
    scene_.world.particles[i].packing = rounded(1 + 0.01 * static_cast<double>(i % 5));
  advance(1e-3);
  int cut = 0;
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const auto& p = scene_.world.particles[i];
    const auto& kind = scene_.world.kind(p);
    const double excess = static_cast<double>(motion_[i].w), density = kind.rest_density + excess;
    const double eta = viscosity(i), limit = tension_limit(i);
    const double pressure = std::max(49 * excess, -limit), volume = p.packing * p.mass / density;
    cut += pressure < 0 && pressure < -0.999 * limit;
    EXPECT_NEAR(static_cast<double>(pressure_[i]), pressure, 4 * epsilon * std::fabs(pressure));
    EXPECT_EQ(state_[i].x, pressure_[i]);
    EXPECT_NEAR(static_cast<double>(state_[i].y), eta, 20 * epsilon * eta);
    EXPECT_NEAR(static_cast<double>(state_[i].z), volume, 4 * epsilon * volume);
    EXPECT_EQ(state_[i].w, static_cast<Real>(p.mass));
    EXPECT_EQ(place_[i].w, state_[i].z);
  }
  EXPECT_GT(cut, 0) << "no pressure reached the tension limit: the scene tests nothing there";
}

TEST_P(Density, VelocityAndPlaceStay) {
  advance(1e-3);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    EXPECT_EQ(xyz(motion_[i]), to_device(scene_.world.particles[i].v));
    EXPECT_EQ(xyz(place_[i]), to_device(scene_.world.particles[i].x));
  }
}

// By a tenth of a radian in a step: along the chords, whose lengths neither strain nor density may show.
TEST_P(Density, RigidMotionHasNoShearRateAndKeepsTheDensity) {
  scene_.world.walls.clear();
  scene_.world.diffusion = 0, scene_.flow.diffusion = 0;
  const double dt = 1e-2;
  const Vec3d spin = scene_.world.dimensions == 3 ? Vec3d{2, -6, 4} : Vec3d{0, 10, 0};
  const Rotation back = rotation(-dt * spin);
  scene_.world.period = {};  // a rotation does not fit into a periodic box
  scene_.box = {};
  for (auto& p : scene_.world.particles) {
    const Vec3d now{p.x.x, p.x.y, p.x.z}, v = (now - back * now) * (1 / dt);
    p.v = {0.3 + v.x, v.y, v.z - 0.2};
    p.excess = std::fabs(p.excess);  // nothing holds a tension
  }
  advance(dt);
  // Velocities up to 1 m/s rounded to epsilon, over a spacing of 0.01 m.
  for (Real rate : shear_rate_) EXPECT_LT(static_cast<double>(rate), 500 * epsilon);
  for (std::size_t i = 0; i < motion_.size(); ++i)
    EXPECT_NEAR(static_cast<double>(motion_[i].w), scene_.world.particles[i].excess,
                500 * epsilon * dt * scene_.world.density(scene_.world.particles[i]))
        << "particle " << i;
}

// Where the density goes on falling, a particle that has been pulled apart takes no more than twice its
// volume, and its density stays above 0.
TEST_P(Density, VolumeOfThinFluidIsBounded) {
  scene_.flow.viscous_tension = false;
  for (auto& p : scene_.world.particles) p.excess = -0.9 * scene_.world.kind(p).rest_density;
  advance(0);
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const auto& p = scene_.world.particles[i];
    EXPECT_NEAR(static_cast<double>(state_[i].z), 2 * p.mass / scene_.world.kind(p).rest_density,
                4 * epsilon * p.volume);
  }
}

TEST_P(Density, CoincidentParticlesStayFinite) {
  auto& p = scene_.world.particles;
  p[1].x = p[0].x;
  p[2].x = p[0].x, p[2].x.z += 1e-9;
  advance(1e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isfinite(motion_[i].w));
    EXPECT_TRUE(std::isfinite(shear_rate_[i]));
  }
}

INSTANTIATE_TEST_SUITE_P(, Density, testing::ValuesIn(all_scenes()),
                         [](const auto& p) { return scene_name(p.param); });

// Uniform shear u = (G z, 0, 0) in the middle of a large lattice: gamma = sqrt(2 D:D) = G. The sum of the
// weight over a cubic lattice at h = 2.6 spacings is 0.998 along its axes; the correction is that of layers
// which slide.
TEST(DensityOnALattice, ShearRateOfUniformShearIsItsGradient) {
  Scene scene({3, Surroundings::free, 7, 0, 1});
  for (auto& p : scene.world.particles)
    p.v = {4 * p.x.z, 0, 0}, p.excess = 0, p.volume = 1e-6, p.fluid = 0, p.mass = 9e-4;
  scene.upload();
  Buffer<Real> scratch(scene.context, "scratch");
  update_density(scene.context, scene.pairs(), scene.fluid, scratch, 0);
  const auto rate = scene.by_id(Span<const Real>(scene.fluid.shear_rate.span()));
  const std::size_t centre = 3 + 7 * (3 + 7 * 3);
  EXPECT_NEAR(square(static_cast<double>(rate[centre]) / 4), viscosity_correction(scene.setup) * 0.998,
              0.001);
}

}  // namespace
}  // namespace slagflow
