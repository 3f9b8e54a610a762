// The measures `flux`, `surface`, `contact` and `residence`, from the case to their columns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/geometry/measure_setup.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/measures/measure_mixing.hpp"
#include "host/measures/measures.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string tank_of(const std::string& wall, const std::string& measures, const std::string& more = "") {
  return R"([case]
name = "tank"
[resolution]
spacing = 0.01
)" + more +
         R"([fluid.oil]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 1
[[region]]
shapes = [{shape="box", min=[0, 0, 0], max=[0.2, 0.1, 0.12]}]
[[wall]]
name = "tank"
shapes = [)" +
         wall + R"(]
[[outlet]]
name = "end"
shape = "plane"
direction = "+x"
position = 0.28
[domain]
min = [-0.03, -0.03, -0.03]
max = [0.3, 0.13, 0.2]
[output]
end_time = 1
)" + measures;
}

const std::string box = R"({shape="box", min=[0, 0, 0], max=[0.2, 0.1, 1], outside=true})";

std::string measure(const std::string& keys) { return "[[measure]]\nname = \"m\"\n" + keys; }

std::string message_of(const std::string& text) {
  try {
    parse_case(text, "tank.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

std::string message_of_measure(const std::string& keys) { return message_of(tank_of(box, measure(keys))); }

struct Measured {
  explicit Measured(const std::string& text)
      : c(parse_case(text, "tank.toml")), built(build_setup(c)), measures(c, built.setup) {
    Simulation simulation(built.setup);
    const auto read = []() -> const FluidSnapshot& {
      static const FluidSnapshot none;
      return none;
    };
    values = measures.update(0, simulation.totals(), read);
    levels = built.setup.surfaces.empty() ? std::vector<LevelState>{} : simulation.surface(0);
  }
  Case c;
  BuiltCase built;
  Measures measures;
  std::vector<double> values;
  std::vector<LevelState> levels;
};

// What a checkpoint holds of the measures tells the same again.
void expect_restored(const Measured& m) {
  Measures again(m.c, m.built.setup);
  again.restore(m.measures.state());
  EXPECT_EQ(again.lines(), m.measures.lines());
  EXPECT_EQ(again.summary().text(), m.measures.summary().text());
}

TEST(ContactMeasure, TellsTheShareOfATankAndItsPressure) {
  const Measured m(tank_of(box, measure("type = \"contact\"\nwall = \"tank\"\n")));
  EXPECT_EQ(
      m.measures.columns(),
      (std::vector<std::string>{"m_wetted_share", "m_wetted_m2", "m_mean_pressure_Pa",
                                "m_largest_pressure_Pa", "m_largest_x_m", "m_largest_y_m", "m_largest_z_m"}));
  // Floor and sides to 0.12 of the 0.2 that the domain shows of them, but for half a row at the surface.
  const double wetted = 0.2 * 0.1 + 2 * (0.2 + 0.1) * 0.12, all = 0.2 * 0.1 + 2 * (0.2 + 0.1) * 0.2;
  EXPECT_NEAR(m.values[0], wetted / all, 0.01);
  EXPECT_NEAR(m.values[1], wetted, 0.01 * wetted);
  EXPECT_NEAR(m.values[3], 1000 * 9.81 * 0.12, 12);
  EXPECT_NEAR(m.values[6], 0, 1e-6);  // on the floor
  EXPECT_THAT(m.measures.lines()[0], HasSubstr("% of tank"));
  expect_restored(m);
}

// A wall alone in the box of 0.2 m with a little fluid; [m^2] of its surface, [m] with two dimensions.
double surface_of(const std::string& shape, const std::string& resolution) {
  std::string text = tank_of(shape, measure("type = \"contact\"\nwall = \"tank\"\n"), resolution);
  const std::size_t region = text.find("[[region]]");
  text.replace(region, text.find("[[wall]]") - region,
               "[[region]]\nshapes = [{shape=\"sphere\", center=[0.01,0.01,0.01], radius=0.02}]\n");
  const SimulationSetup s = build_setup(parse_case(text, "plate.toml")).setup;
  double area = 0;
  for (const double site : s.site_area) area += site;
  return area;
}

TEST(SiteAreas, AreThoseOfPlatesAtAnyAngle) {
  for (const double angle : {0.0, 0.1745, 0.5236, 0.7854, 1.2}) {
    const std::string plate = R"({shape="box", min=[0.05, -1, 0.06], max=[0.15, 1, 0.12], rotate=[0,)" +
                              std::to_string(angle) + ",0], rotate_about=[0.1, 0, 0.09]}";
    const double area = 2 * (0.1 + 0.06);
    EXPECT_NEAR(surface_of(plate, "dimensions = 2\n"), area, angle == 0 ? 1e-9 : 0.01 * area) << angle;
  }
}

TEST(SiteAreas, AreThoseOfRoundBodies) {
  constexpr double pi = 3.14159265358979323846;
  const double disc = surface_of(R"({shape="cylinder", start=[0.1,-1,0.1], end=[0.1,1,0.1], radius=0.05})",
                                 "dimensions = 2\n");
  EXPECT_NEAR(disc, 2 * pi * 0.05, 0.01 * disc);
  const double sphere = surface_of(R"({shape="sphere", center=[0.1,0.05,0.1], radius=0.045})", "");
  EXPECT_NEAR(sphere, 4 * pi * 0.045 * 0.045, 0.01 * sphere);
}

TEST(SurfaceMeasure, TellsTheHeightOverAGrid) {
  const Measured m(
      tank_of(box, measure("type = \"surface\"\nstart = [0.05, 0.03, 0.02]\nend = [0.15, 0.03, 0.02]\n"
                           "points = 5\nacross = [0, 0.04, 0]\nrows = 2\n")));
  ASSERT_EQ(m.levels.size(), 10U);
  EXPECT_EQ(m.measures.columns(),
            (std::vector<std::string>{"m_highest_m", "m_mean_thickness_m", "m_covered_share"}));
  EXPECT_NEAR(m.values[0], 0.12, 0.0005);
  EXPECT_NEAR(m.values[1], 0.10, 0.0005);
  EXPECT_NEAR(m.values[2], 1, 1e-12);
  const Vec3d last = m.built.setup.surfaces[0].columns.back().start;
  EXPECT_NEAR(last.x, 0.15, 1e-12);
  EXPECT_NEAR(last.y, 0.07, 1e-12);
  expect_restored(m);
}

TEST(FluxMeasure, HasColumnsOfVolumeAndMass) {
  const Measured m(tank_of(box, measure("type = \"flux\"\ncenter = [0.2, 0.05, 0.1]\nnormal = [2, 0, 0]\n"
                                        "height = 0.1\nwidth = 0.2\n")));
  EXPECT_EQ(m.measures.columns(), (std::vector<std::string>{"m_forward_m3", "m_backward_m3", "m_flow_m3_s",
                                                            "m_forward_kg", "m_backward_kg"}));
  const RectangleSetup& r = m.built.setup.rectangles[0];
  EXPECT_NEAR(r.normal.x, 1, 1e-12);
  EXPECT_NEAR(r.v.z, 1, 1e-12);
  EXPECT_NEAR(r.half_u, 0.1, 1e-12);
  EXPECT_THAT(m.measures.lines()[0], StartsWith("m (flux): forward 0 m3, 0 kg; backward 0 m3"));
  expect_restored(m);
}

TEST(ResidenceMeasure, HasTheAgesOfWhatLeaves) {
  const Measured m(tank_of(box, measure("type = \"residence\"\noutlet = \"end\"\n")));
  EXPECT_EQ(m.measures.columns()[1], "m_mean_s");
  EXPECT_EQ(m.measures.lines()[0], "m (residence): nothing has left through end");
  EXPECT_EQ(m.values.back(), 0);  // age of what is inside
  expect_restored(m);
}

using Cells = std::vector<std::array<double, 2>>;

TEST(Mixing, IsNoneWhereFluidsAreApartAndOneWhereTheyAreAsAtRandom) {
  EXPECT_NEAR(mixing_of(Cells{{100, 100}, {0, 100}}, 100).index, 0, 1e-12);
  EXPECT_NEAR(mixing_of(Cells{{50, 100}, {50, 100}}, 100).index, 1, 1e-12);
  // Shares of 0.75 and 0.25: (0.25 - 0.0625)/(0.25 - 0.0025).
  EXPECT_NEAR(mixing_of(Cells{{75, 100}, {25, 100}}, 100).index, 0.1875 / 0.2475, 1e-12);
  EXPECT_NEAR(mixing_of(Cells{{75, 100}, {25, 100}}, 100).share, 0.5, 1e-12);
  // At random: s^2 = p (1 - p)/n.
  EXPECT_NEAR(mixing_of(Cells{{55, 100}, {45, 100}}, 100).index, 1, 1e-12);
  // A cell that is nearly empty is left out; one fluid alone has no index.
  EXPECT_NEAR(mixing_of(Cells{{50, 100}, {50, 100}, {20, 20}}, 100).share, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(mixing_of(Cells{{100, 100}, {100, 100}}, 100).index));
  EXPECT_TRUE(std::isnan(mixing_of(Cells{}, 100).share));
}

TEST(MixingMeasure, LooksAtTheCellsOfItsBox) {
  // Oil of another name lies on the oil, in layers of six: cells of three see them apart, one of twelve
  // mixed.
  std::string text = tank_of(box, measure("type = \"mixing\"\nfluid = \"upper\"\nmin = [0, 0, 0]\n"
                                          "max = [0.18, 0.09, 0.12]\ncell = 0.03\n") +
                                      "[[measure]]\nname = \"coarse\"\ntype = \"mixing\"\nfluid = \"oil\"\n"
                                      "min = [0, 0, 0]\nmax = [0.12, 0.1, 0.12]\ncell = 0.12\n");
  text.replace(text.find("[[region]]"), 10, R"([fluid.upper]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 1
[[region]]
fluid = "upper"
shapes = [{shape="box", min=[0, 0, 0.06], max=[0.2, 0.1, 0.12]}]
[[region]]
fluid = "oil")");
  const Case c = parse_case(text, "tank.toml");
  const BuiltCase built = build_setup(c);
  Measures measures(c, built.setup);
  Simulation simulation(built.setup);
  FluidSnapshot snapshot;
  simulation.read(snapshot);
  const auto read = [&]() -> const FluidSnapshot& { return snapshot; };
  const std::vector<double> values = measures.update(0, simulation.totals(), read);
  EXPECT_EQ(measures.columns(),
            (std::vector<std::string>{"m_index", "m_share", "coarse_index", "coarse_share"}));
  EXPECT_NEAR(values[0], 0, 1e-9);
  EXPECT_NEAR(values[1], 0.5, 1e-9);
  EXPECT_NEAR(values[2], 1, 1e-9);
  EXPECT_NEAR(values[3], 0.5, 1e-9);
  EXPECT_THAT(measures.lines()[0], HasSubstr("index 0 of upper, 50 % of the fluid in its box"));
  Measures again(c, built.setup);
  again.restore(measures.state());
  EXPECT_EQ(again.lines(), measures.lines());
}

TEST(ProbeKeys, AreRefusedWithPlaceAndWhatIsAllowed) {
  const std::string flux = "type = \"flux\"\ncenter = [0.2, 0.05, 0.1]\nheight = 0.1\nwidth = 0.2\n";
  EXPECT_EQ(message_of_measure(flux + "normal = [1, 0, 0]\n"), "no error");
  EXPECT_THAT(message_of_measure(flux + "normal = [0, 0, 0]\n"),
              HasSubstr("key 'measure.0.normal': value [0, 0, 0]: allowed: a vector of any length above 0"));
  EXPECT_THAT(message_of_measure(flux), HasSubstr("key 'measure.0.normal': missing"));
  EXPECT_THAT(
      message_of_measure("type = \"flux\"\ncenter = [5, 0, 0]\nheight = 1\nwidth = 1\nnormal = [1, 0, 0]"),
      HasSubstr("tank.toml:27: key 'measure.0.center': value [5.0, 0.0, 0.0] is outside the domain"));
  EXPECT_THAT(message_of_measure("type = \"contact\"\nwall = \"tub\""), HasSubstr("tank"));
  EXPECT_THAT(message_of_measure("type = \"residence\"\noutlet = \"drain\""), HasSubstr("end"));
  EXPECT_THAT(message_of_measure("type = \"residence\""), HasSubstr("key 'measure.0.outlet': missing"));
  const std::string line = "type = \"surface\"\nstart = [0.05, 0.03, 0]\nend = [0.15, 0.03, 0]\n";
  EXPECT_EQ(message_of_measure(line), "no error");
  EXPECT_THAT(message_of_measure(line + "rows = 3"),
              HasSubstr("key 'measure.0.across': is [0, 0, 0] with 3 rows: allowed: another vector"));
  EXPECT_THAT(message_of_measure(line + "rows = 3\nacross = [0, 1, 0]"),
              HasSubstr("key 'measure.0.across': value [0.0, 1.0, 0.0] leads out of the domain"));
  EXPECT_THAT(message_of_measure(line + "rows = 5000\nacross = [0, 0.01, 0]"),
              HasSubstr("value 5000 makes 250000 columns: allowed: points times rows up to 100000"));
  EXPECT_THAT(message_of_measure("type = \"surface\"\nstart = [0.05, 0.03, 0]\nend = [0.05, 0.03, 0.1]\n"),
              HasSubstr("is straight above or below the start: allowed: a line across gravity"));
  EXPECT_THAT(message_of_measure("type = \"mixing\"\nfluid = \"oil\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n"),
              HasSubstr("value \"mixing\" with one fluid: allowed: two or more"));
  EXPECT_THAT(message_of_measure("type = \"level\"\nrows = 2\n"),
              HasSubstr("rows goes with type = \"surface\""));
}

}  // namespace
}  // namespace slagflow
