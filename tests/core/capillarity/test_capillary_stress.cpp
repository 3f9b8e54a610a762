// Acceleration by surface tension against sums over all pairs in double precision.
#include <gtest/gtest.h>

#include <cmath>

#include "capillarity/surface_tension.hpp"
#include "core/scene.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;
using reference::Vec;

constexpr double pi = 3.14159265358979323846;
// Of a sum, over the sizes of its terms: some ten operations to a term, and as many terms in a lane.
constexpr double rounding = 20 * epsilon;

// What surface_tension.hpp says of one particle.
struct Capillary {
  Vec n, s, t;
  double push = 0, k = 0;
  Vec stress(double noise, Vec d) const {
    const double size_n = std::sqrt(dot(n, n));
    return k / (size_n + noise) * (dot(n, n) * d - dot(n, d) * n);
  }
  Vec along_wall(Vec d) const { return d - dot(t, d) * t; }
};

class Oracle {
 public:
  Oracle(const Scene& scene) : w_(scene.world), setup_(scene.setup), noise_(colour_noise / w_.support) {
    for (std::size_t i = 0; i < w_.particles.size(); ++i) particles_.push_back(of(i));
  }

  reference::Sum acceleration(std::size_t i) const {
    const reference::Particle& p = w_.particles[i];
    const Capillary& own = particles_[i];
    const auto* const first = w_.particles.data();
    reference::Sum sum;
    const auto add = [&](Vec term) { sum.add(term, length(term)); };
    reference::for_fluid_pairs(w_, i, [&](const reference::Particle& j, Vec d) {
      const Capillary& other = particles_[static_cast<std::size_t>(&j - first)];
      const double factor = -p.volume * j.volume / p.mass, f = slope(d);
      for (const Capillary* c : {&own, &other}) {
        add(factor * weight(length(d)) * c->stress(noise_, d));
        add(factor * f * c->push * c->along_wall(d));
      }
    });
    reference::for_wall_pairs(w_, i, [&](const reference::Wall&, Vec d) {
      const double pull = -2 * p.volume * w_.wall_volume() / p.mass * weight(length(d));
      add(pull * dot(own.stress(noise_, own.t), d) * own.t);
    });
    return sum;
  }

 private:
  // The colour has Lucy's function whatever the pressure has.
  double slope(Vec d) const {
    const reference::SmoothingFunction lucy{reference::Kernel::lucy, w_.support, w_.dimensions};
    return lucy.slope(length(d)) / length(d);
  }

  double weight(double r) const {
    const double q = r / w_.support, h = w_.support;
    return (w_.dimensions == 3 ? 189 / std::pow(h, 5) : 168 / std::pow(h, 4)) / pi * q * q * (1 - q) *
           (1 - q);
  }

  Capillary of(std::size_t i) const {
    Capillary c;
    reference::for_fluid_pairs(
        w_, i, [&](const reference::Particle& j, Vec d) { c.n = c.n + j.volume * slope(d) * d; });
    Vec with_cosine;
    reference::for_wall_pairs(w_, i, [&](const reference::Wall& wall, Vec d) {
      const Vec term = w_.wall_volume() * slope(d) * d;
      const auto body = setup_.walls.body[static_cast<std::size_t>(&wall - w_.walls.data())];
      c.s = c.s + term,
      with_cosine = with_cosine + std::cos(pi / 180 * setup_.bodies[body].contact_angle) * term;
    });
    c.n = c.n + c.s;
    const double sigma = setup_.fluids[static_cast<std::size_t>(w_.particles[i].fluid)].surface_tension;
    c.k = sigma / plane_surface_tension(w_.dimensions);
    const double size = length(c.s);
    if (size > 0) {
      c.t = 1 / size * c.s;
      c.push = sigma / plane_wall_tension(w_.dimensions) * dot(c.s, with_cosine) / (size + noise_);
    }
    return c;
  }

  const reference::World& w_;
  const SimulationSetup& setup_;
  double noise_;
  std::vector<Capillary> particles_;
};

class CapillaryStressIn : public testing::TestWithParam<int> {};

TEST_P(CapillaryStressIn, MatchesTheSumsOverAllPairs) {
  SceneOptions options;
  options.dimensions = GetParam();
  Scene scene(options);
  scene.setup.fluids[0].surface_tension = 0.5, scene.setup.fluids[1].surface_tension = 2;
  for (const double angle : {50.0, 130.0}) {
    WallBody body;
    body.contact_angle = angle;
    scene.setup.bodies.push_back(body);
  }
  for (std::size_t j = 0; j < scene.world.walls.size(); ++j)
    scene.setup.walls.body.push_back(scene.world.walls[j].normal.x > 0 ? 1 : 0);
  scene.upload();
  SurfaceTension tension(scene.context, scene.setup);
  tension.reserve(scene.fluid.count);
  tension.update(scene.pairs(), scene.wall.id.span());
  const std::vector<Quad> found = scene.by_id(tension.acceleration());
  const Oracle oracle(scene);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const reference::Sum exact = oracle.acceleration(i);
    EXPECT_LT(length(to_host(found[i]) - exact.value), rounding * exact.size) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CapillaryStressIn, testing::Values(2, 3));

}  // namespace
}  // namespace slagflow
