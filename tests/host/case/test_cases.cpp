// The case files that come with the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "host/geometry/setup_builder.hpp"

namespace slagflow {
namespace {

std::string path_of(const std::string& name) {
  return std::string(SLAGFLOW_SOURCE_DIR) + "/cases/" + name + ".toml";
}

// Fluid particles, by the comments of the cases.
const std::map<std::string, std::size_t> counts{
    {"dam_discharge", 102000}, {"dam_discharge_2mm", 12500}, {"dam_discharge_quick", 2700},
    {"slag", 12500},           {"slurry_a_phi50", 12500},    {"oil_a", 12500},
    {"oil_b", 12500},          {"hydrostatic_tank", 1600},   {"hydrostatic_bingham", 1600},
    {"column_collapse", 6400}, {"spinning_block", 1000},     {"l_box", 2592},
    {"tailings_dam", 5260},    {"mini_slump", 4664}};

TEST(Cases, EveryFileLoadsBuildsAsItsCommentSaysAndWritesItselfBack) {
  int files = 0;
  std::size_t counted = 0;
  const std::string folder = std::string(SLAGFLOW_SOURCE_DIR) + "/cases";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".toml" || entry.path().parent_path().filename() == "sweeps") continue;
    ++files;
    SCOPED_TRACE(entry.path().string());
    const Case c = load_case(entry.path().string());
    EXPECT_EQ(c.name, entry.path().stem().string());
    EXPECT_FALSE(c.description.empty());
    const BuiltCase built = build_setup(c);
    EXPECT_GT(built.setup.numerics.sound_speed, 0);
    // Two may lose pressure as they settle: the more of it, the more noise. One is there for what its walls
    // do.
    const char* expected =
        c.name == "off_lattice" ? "spacings off the lattice" : "fills a closed space, and loses about 9.6 Pa";
    EXPECT_THAT(built.warnings, testing::Each(testing::HasSubstr(expected)));
    if (const auto count = counts.find(c.name); count != counts.end()) {
      EXPECT_EQ(built.setup.particles.position.size(), count->second);
      ++counted;
    }
    const std::string written = to_toml(built.resolved);
    EXPECT_EQ(to_toml(parse_case(written, "resolved.toml")), written);
    const SimulationSetup& setup = built.setup;
    const auto forces = std::count_if(c.measures.begin(), c.measures.end(), [](const MeasureSpec& m) {
      return m.type == MeasureType::force || m.type == MeasureType::heat;
    });
    EXPECT_EQ(setup.fronts.size() + setup.planes.size() + setup.boxes.size() + setup.lines.size() +
                  setup.levels.size() + setup.rectangles.size() + setup.surfaces.size() +
                  setup.contacts.size() + setup.residences.size() + setup.solids.size() +
                  static_cast<std::size_t>(forces),
              c.measures.size());
  }
  EXPECT_GE(files, 10);
  EXPECT_EQ(counted, counts.size());
}

TEST(Cases, DamHasFloorSidesAndVerticalFace) {
  const Case c = load_case(path_of("dam_discharge"));
  const SimulationSetup s = build_setup(c).setup;
  EXPECT_GT(s.walls.position.size(), 60000u);
  EXPECT_LT(s.walls.position.size(), 120000u);
  for (std::size_t i = 0; i < s.walls.position.size(); ++i) {
    const Vec3d n = s.walls.normal[i], p = s.walls.position[i];
    EXPECT_GE(n.x, 0);  // back wall and face look along +x
    EXPECT_GE(n.z, 0);
    // Whole layers: 0.5, 1.5 or 2.5 spacings deep.
    const double layer = s.walls.depth[i] / s.spacing - 0.5;
    EXPECT_NEAR(layer, std::round(layer), 1e-6);
    EXPECT_LT(layer, 2.5) << p.x << " " << p.y << " " << p.z;
    // Only the side walls look sideways, and they stand beside the channel.
    if (n.y != 0) {
      EXPECT_GT(std::abs(p.y), 0.0255);
    }
  }
}

TEST(Cases, OverridesScaleTheDam) {
  const Case c =
      load_case(path_of("dam_discharge_2mm"), {"resolution.spacing=2.5e-3", "fluid.slurry.yield_stress=40"});
  EXPECT_EQ(build_setup(c).setup.particles.position.size(), 20u * 40u * 8u);
  EXPECT_EQ(c.fluids[0].parameters[1], 40);
}

}  // namespace
}  // namespace slagflow
