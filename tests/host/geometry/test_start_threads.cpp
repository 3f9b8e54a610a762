// The start is the same to the bit however many threads build it, and what works on whole words of sites does
// what steps from site to site do.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "backend/device.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/geometry/site_bits.hpp"
#include "host/geometry/touching.hpp"
#include "host/geometry_cases.hpp"
#include "host/run/check.hpp"

namespace slagflow {
namespace {

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

class StartOf : public testing::TestWithParam<const char*> {};

TEST_P(StartOf, IsTheSameForAnyNumberOfThreads) {
  const Case c = load_case(std::string(SLAGFLOW_SOURCE_DIR) + "/cases/" + GetParam());
  const int threads = device_info().threads;
  set_threads(1);
  const BuiltCase one = build_setup(c);
  const std::string figures = to_json(check_case(one)).text();
  for (const int more : {2, 5}) {
    set_threads(more);
    const BuiltCase other = build_setup(c);
    const FluidParticles &fluid = one.setup.particles, &same = other.setup.particles;
    EXPECT_TRUE(same_bytes(fluid.position, same.position) && same_bytes(fluid.velocity, same.velocity));
    EXPECT_TRUE(same_bytes(fluid.pressure, same.pressure) && same_bytes(fluid.fluid, same.fluid));
    const WallParticles &walls = one.setup.walls, &as = other.setup.walls;
    EXPECT_TRUE(same_bytes(walls.position, as.position) && same_bytes(walls.normal, as.normal));
    EXPECT_TRUE(same_bytes(walls.depth, as.depth) && same_bytes(walls.body, as.body));
    EXPECT_TRUE(same_bytes(walls.back_normal, as.back_normal) && same_bytes(walls.back_depth, as.back_depth));
    EXPECT_EQ(one.warnings, other.warnings);
    EXPECT_EQ(to_json(check_case(other)).text(), figures);
  }
  set_threads(threads);
}

INSTANTIATE_TEST_SUITE_P(Cases, StartOf,
                         testing::Values("dam_discharge_gate.toml", "howto/raking.toml",
                                         "howto/pot_from_cad.toml", "verification/accelerated_box.toml",
                                         "verification/two_oils.toml"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& letter : name)
                             if (letter == '/' || letter == '.') letter = '_';
                           return name;
                         });

// A lattice of some shape, periodic along x.
Lattice lattice_of(Vec3d size) {
  Case c = unit_case();
  c.domain.upper = size;
  c.domain.periodic = {true, false, false};
  return Lattice(c);
}

TEST(SiteBits, WidenAsStepsFromSiteToSiteDo) {
  for (const Vec3d size : {Vec3d{70, 4, 3}, Vec3d{5, 6, 4}, Vec3d{128, 3, 3}}) {
    const Lattice lattice = lattice_of(size);
    SiteBits bits(lattice);
    const auto [nx, ny, nz] = lattice.count();
    for (std::int64_t k = 0; k < nx * ny * nz; k += 97) bits.set({k % nx, k / nx % ny, k / (nx * ny)});
    const SiteBits wide = bits.widened(lattice);
    const std::int64_t n = lattice.layers();
    for (std::int64_t k = 0; k < nx * ny * nz; ++k) {
      const SiteIndex site{k % nx, k / nx % ny, k / (nx * ny)};
      bool expected = false;
      for (std::int64_t z = -n; z <= n; ++z)
        for (std::int64_t y = -n; y <= n; ++y)
          for (std::int64_t x = -n; x <= n; ++x) {
            SiteIndex s = site;
            if (lattice.move(s, 0, x) && lattice.move(s, 1, y) && lattice.move(s, 2, z))
              expected = expected || bits.test(s);
          }
      ASSERT_EQ(wide.test(site), expected) << site[0] << " " << site[1] << " " << site[2];
    }
  }
}

// Numbers all that touches a particle, from site to site.
std::vector<std::int32_t> flooded(const StartSites& sites) {
  const Lattice& lattice = sites.lattice();
  std::vector<std::int32_t> of(sites.particles(), StartSites::none);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (of[i] != StartSites::none) continue;
    std::vector<std::size_t> edge{i};
    of[i] = count;
    while (!edge.empty()) {
      const SiteIndex here = sites.index(sites.taken()[edge.back()]);
      edge.pop_back();
      for (std::int64_t k = 0; k < 27; ++k) {
        SiteIndex s = here;
        if (!lattice.move(s, 0, k % 3 - 1) || !lattice.move(s, 1, k / 3 % 3 - 1) ||
            !lattice.move(s, 2, k / 9 - 1))
          continue;
        const std::int32_t other = sites.fluid(lattice.linear(s));
        if (other == StartSites::none || of[static_cast<std::size_t>(other)] != StartSites::none) continue;
        of[static_cast<std::size_t>(other)] = count;
        edge.push_back(static_cast<std::size_t>(other));
      }
    }
    ++count;
  }
  return of;
}

TEST(TouchingBodies, AreThoseThatAFloodFinds) {
  for (const std::uint64_t share : {3u, 8u, 20u}) {  // of sites without fluid to one with
    const Lattice lattice = lattice_of({67, 8, 7});
    std::vector<std::size_t> taken;
    std::uint64_t random = 1;
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      random = 6364136223846793005u * random + 1442695040888963407u;
      if ((random >> 33) % share == 0) taken.push_back(lattice.size() - 1 - k);
    }
    const StartSites sites(lattice, std::vector<std::uint8_t>(lattice.size(), 0), taken);
    EXPECT_EQ(touching_bodies(sites).of, flooded(sites));
  }
}

}  // namespace
}  // namespace slagflow
