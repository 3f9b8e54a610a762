// Wrong cases: each must be refused with a message that says where, what and what is allowed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "backend/error.hpp"
#include "host/case/case.hpp"

namespace slagflow {
namespace {

const std::vector<std::string> good_lines{
    "[case]",                                                       // 1
    "name = 'tank'",                                                // 2
    "[resolution]",                                                 // 3
    "spacing = 1e-3",                                               // 4
    "[gravity]",                                                    // 5
    "acceleration = [0, 0, -9.81]",                                 // 6
    "[fluid.slag]",                                                 // 7
    "density = 965",                                                // 8
    "rheology = 'bingham'",                                         // 9
    "plastic_viscosity = 0.5",                                      // 10
    "yield_stress = 5",                                             // 11
    "[[region]]",                                                   // 12
    "fluid = 'slag'",                                               // 13
    "shapes = [{shape='box', min=[0,0,0], max=[0.01,0.01,0.01]}]",  // 14
    "[[wall]]",                                                     // 15
    "name = 'floor'",                                               // 16
    "shapes = [{shape='plane', point=[0,0,0], normal=[0,0,1]}]",    // 17
    "[domain]",                                                     // 18
    "min = [-0.01, -0.01, -0.01]",                                  // 19
    "max = [0.02, 0.02, 0.02]",                                     // 20
    "[numerics]",                                                   // 21
    "courant = 0.5",                                                // 22
    "[output]",                                                     // 23
    "end_time = 1",                                                 // 24
    "[[measure]]",                                                  // 25
    "name = 'front'",                                               // 26
    "type = 'front'",                                               // 27
    "direction = '-z'",                                             // 28
    "position = 0",                                                 // 29
};

std::string text_with(std::size_t line, const std::string& replacement) {
  std::string text;
  for (std::size_t i = 0; i < good_lines.size(); ++i)
    text += (i + 1 == line ? replacement : good_lines[i]) + "\n";
  return text;
}

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "case.toml", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

struct Wrong {
  std::size_t line;  // that is replaced
  std::string replacement;
  std::vector<std::string> fragments;
};
const std::vector<Wrong> wrong_cases{
    {2, "name = ", {"case.toml:2: not TOML"}},
    {2, "name = 'a", {"case.toml:2: not TOML"}},
    {8, "density = 965\ndensity = 966", {"case.toml:9: not TOML", "density"}},
    {1, "[case", {"case.toml:1: not TOML"}},
    {8, "density = 965,5", {"case.toml:8: not TOML", "in \"density = 965,5\"", "write 965.5"}},
    {8, "density = 2,700.0", {"case.toml:8: not TOML", "no commas in numbers: write 2700.0"}},
    {9, "rheology = bingham  # the word", {"case.toml:9: not TOML", "write \"bingham\""}},
    {8, "density = .5", {"case.toml:8: not TOML", "write 0.5"}},
    {8, "density = -5.e-3 # 5.", {"case.toml:8: not TOML", "write -5.0e-3"}},
    {2, "name = 'a'\nx = " + std::string(300, '['), {"case.toml:3: brackets nested deeper"}},
    {8,
     "densty = 965",
     {"case.toml:8: key 'fluid.slag.densty': unknown: did you mean 'density'?",
      "case.toml:7: key 'fluid.slag.density': missing"}},
    {22, "curant = 0.5", {"case.toml:22: key 'numerics.curant': unknown: did you mean 'courant'?"}},
    {21, "[numeric]", {"case.toml:21: key 'numeric': unknown: did you mean 'numerics'?"}},
    {22, "quite_another = 1", {"'numerics.quite_another': unknown: allowed: scheme, kernel, viscous_weight"}},
    {14,
     "shapes = [{shape='box', min=[0,0,0], max=[1,1,1], radius=1}]",
     {"case.toml:14: key 'region.0.shapes.0.radius': unknown: allowed: shape, min, max, translate, rotate"}},
    {29, "position = 0\nlip = [0,0,0]", {"case.toml:30: key 'measure.0.lip': unknown"}},
    {9,
     "rheology = 'newtonian'",
     {"key 'fluid.slag.dynamic_viscosity': missing", "case.toml:11: key 'fluid.slag.yield_stress': unknown"}},
    {8,
     "density = 965\nsurface_tension = -1",
     {"case.toml:9: key 'fluid.slag.surface_tension': value -1", "allowed: a number >= 0.0 [N/m]"}},
    {16,
     "name = 'w'\ncontact_angle = 181",
     {"case.toml:17: key 'wall.0.contact_angle': value 181",
      "allowed: a number >= 0.0 and <= 180.0 [degrees]"}},
    // Missing keys
    {4, "", {"case.toml:3: key 'resolution.spacing': missing: required: a number > 0.0 [m]"}},
    {2, "", {"case.toml:1: key 'case.name': missing"}},
    {11, "", {"case.toml:7: key 'fluid.slag.yield_stress': missing: required: a number >= 0.0 [Pa]"}},
    {14, "", {"case.toml:12: key 'region.0.shapes': missing"}},
    {16, "", {"case.toml:15: key 'wall.0.name': missing"}},
    {20, "", {"case.toml:18: key 'domain.max': missing: required: a list [x, y, z]"}},
    {24, "", {"case.toml:23: key 'output.end_time': missing"}},
    {27, "", {"case.toml:25: key 'measure.0.type': missing: required: front, jet"}},
    {28, "", {"case.toml:25: key 'measure.0.direction': missing: required: -x, +x, -y, +y, -z, +z"}},
    // Wrong types
    {2, "name = 3", {"case.toml:2: key 'case.name': value 3 has the wrong type: allowed: a string"}},
    {4,
     "spacing = '1 mm'",
     {"case.toml:4: key 'resolution.spacing': value \"1 mm\" has the wrong type: allowed: a number"}},
    {6,
     "acceleration = 9.81",
     {"case.toml:6: key 'gravity.acceleration': value 9.81 has the wrong type: allowed: a list"}},
    {6, "acceleration = [0, -9.81]", {"case.toml:6", "value [0, -9.81] has the wrong type"}},
    {6, "acceleration = [0, 0, 'g']", {"case.toml:6", "value [0, 0, \"g\"] has the wrong type"}},
    {12,
     "[region]",
     {"case.toml:12: key 'region': value {...} has the wrong type: allowed: a list of tables"}},
    {15,
     "wall = 3\n[[walls]]",
     {"case.toml:15: key 'region.0.wall': unknown",
      "case.toml:16: key 'walls': unknown: did you mean 'wall'?"}},
    {1, "wall = 3\n[case]", {"not TOML"}},
    {22,
     "max_iterations = 10.5",
     {"case.toml:22: key 'numerics.max_iterations': value 10.5 has the wrong type: allowed: an integer from "
      "1 to 100000"}},
    {24,
     "end_time = 1\nwalls = 'yes'",
     {"case.toml:25: key 'output.walls': value \"yes\" has the wrong type: allowed: true or false"}},
    {24,
     "end_time = 2020-01-01",
     {"case.toml:24: key 'output.end_time': value 2020-01-01 has the wrong type"}},
    // Out of range
    {8,
     "density = -3",
     {"case.toml:8: key 'fluid.slag.density': value -3 is out of range: allowed: a number >= 0.001"}},
    {8, "density = nan", {"case.toml:8", "value nan is out of range"}},
    {4, "spacing = inf", {"case.toml:4", "value inf is out of range"}},
    {4, "spacing = 0", {"case.toml:4", "value 0 is out of range: allowed: a number > 0.0 [m]"}},
    {4,
     "spacing = 1e-3\nsupport_ratio = 5",
     {"case.toml:5", "value 5 is out of range: allowed: a number >= 1.5 and <= 4.0"}},
    {4, "spacing = 1e-3\ndimensions = 1", {"case.toml:5", "allowed: an integer from 2 to 3"}},
    {10,
     "plastic_viscosity = 0",
     {"case.toml:10: key 'fluid.slag.plastic_viscosity': value 0 is out of range"}},
    {11,
     "yield_stress = -1e-9",
     {"case.toml:11", "value -1e-09 is out of range: allowed: a number >= 0.0 [Pa]"}},
    {11, "yield_stress = 5\ngrowth_exponent = 0", {"case.toml:12", "allowed: a number > 0.0 [s]"}},
    {9,
     "rheology = 'herschel-bulkley'\nflow_index = 2.1\nconsistency = 1",
     {"case.toml:10: key 'fluid.slag.flow_index': value 2.1 is out of range: allowed: a number > 0.0 and <= "
      "2.0"}},
    {9,
     "rheology = 'bi-viscous'\nviscosity_ratio = 0.9",
     {"case.toml:10", "value 0.9 is out of range: allowed: a number >= 1.0 and <= 1e+09"}},
    {9,
     "rheology = 'carreau-yasuda'\nflow_index = 1.1\ntransition = 0",
     {"case.toml:10", "allowed: a number > 0.0 and <= 1.0", "case.toml:11", ">= 0.1 and <= 10.0",
      "key 'fluid.slag.relaxation_time': missing"}},
    {9, "rheology = 'casson'", {"key 'fluid.slag.casson_viscosity': missing"}},
    {22, "courant = 0", {"case.toml:22", "allowed: a number > 0.0 and <= 1.2"}},
    {22, "shifting = 5.5", {"case.toml:22", "numerics.shifting", "allowed: a number >= 0.0 and <= 5.0"}},
    {22, "theta = 0.4", {"case.toml:22", "allowed: a number >= 0.5 and <= 1.0"}},
    {22, "relaxation = 2", {"case.toml:22", "allowed: a number > 0.0 and < 2.0"}},
    {22, "yield = \"exactly\"", {"case.toml:22", "did you mean 'exact'? allowed: regularised, exact"}},
    {22, "yield_iterations = 0", {"case.toml:22", "allowed: an integer from 1 to 100000"}},
    {22, "yield_augmentation = 0", {"case.toml:22", "allowed: a number > 0.0 [or \"auto\"]"}},
    {22, "max_iterations = 0", {"case.toml:22", "allowed: an integer from 1 to 100000"}},
    {22, "sound_speed = 0", {"case.toml:22", "or \"auto\""}},
    {22, "sound_speed = 'fast'", {"case.toml:22", "value \"fast\" has the wrong type"}},
    {24,
     "end_time = 1\ninterval = 1e-9",
     {"case.toml:25: key 'output.interval': value 1e-09 is out of range"}},
    {24, "end_time = 1\nuntil = 1e9", {"case.toml:25: key 'output.until': value 1e+09 is out of range"}},
    {24, "end_time = 1\nuntil = 'later'", {"case.toml:25: key 'output.until'", "or \"end_time\""}},
    // Beyond single precision
    {4,
     "spacing = 1.9e-6",
     {"case.toml:4: key 'resolution.spacing': value 1.9e-06 with numerics.yield = \"regularised\" is beyond "
      "what single precision holds the powers of: allowed: 2e-06 to 10000.0 [m]"}},
    {4, "spacing = 10001", {"case.toml:4: key 'resolution.spacing': value 10001.0 with numerics.yield"}},
    {29, "position = 0\nfraction = 1", {"case.toml:30", "allowed: a number > 0.0 and < 1.0"}},
    // Words
    {9,
     "rheology = 'bingam'",
     {"case.toml:9: key 'fluid.slag.rheology': value \"bingam\" is unknown: did you mean 'bingham'? allowed: "
      "newtonian, bingham"}},
    {22, "solver = 'gauss'", {"case.toml:22", "allowed: multigrid, conjugate_gradient, sor, jacobi"}},
    {22, "kernel = 'gauss'", {"case.toml:22", "allowed: level, lucy, wendland-c2"}},
    {28, "direction = 'down'", {"case.toml:28: key 'measure.0.direction': value \"down\" is unknown"}},
    {16, "name = 'floor'\nslip = 'slip'", {"case.toml:17", "allowed: no_slip, free_slip"}},
    {13,
     "fluid = 'water'",
     {"case.toml:13: key 'region.0.fluid': value \"water\" is unknown: allowed: slag"}},
    {13,
     "[fluid.oil]\ndensity=1\nrheology='newtonian'\ndynamic_viscosity=1\n[[region]]",
     {"case.toml:12: key 'region.0.fluid': missing: required: slag, oil", "key 'region.0.shapes': missing"}},
    // Names
    {2, "name = '../tank'", {"case.toml:2: key 'case.name': value \"../tank\" is not a name"}},
    {2, "name = '..'", {"case.toml:2: key 'case.name': value \"..\" is not a name"}},
    {2, "name = ''", {"case.toml:2: key 'case.name': value \"\" is not a name"}},
    {17,
     good_lines[16] + "\n[[wall]]\nname = 'floor'\n" + good_lines[16],
     {"case.toml:19: key 'wall.1.name': value \"floor\" is given twice"}},
    {7, "[fluid.'a b']", {"case.toml:7: key 'fluid.a b': the name of a fluid"}},
    // Geometry
    {13, "jitter = 0.7", {"case.toml:13: key 'region.0.jitter': value 0.7 is out of range"}},
    {13, "pressure = -1", {"case.toml:13: key 'region.0.pressure': value -1 is out of range"}},
    {13,
     "pressure = 'half'",
     {"key 'region.0.pressure': value \"half\" is unknown: allowed: hydrostatic, zero"}},
    {13, "waves = [{amplitude=[1,0,0]}]", {"case.toml:13: key 'region.0.waves.0.wave_vector': missing"}},
    {14, "shapes = []", {"case.toml:14: key 'region.0.shapes': value [] is empty"}},
    {14,
     "shapes = [{shape='box', min=[0,0,0], max=[1,0,1]}]",
     {"case.toml:14: key 'region.0.shapes.0.max': value 0.0 along y is not above min: allowed: > 0.0 [m]"}},
    {14, "shapes = [{shape='cone'}]", {"case.toml:14", "allowed: box, plane, cylinder, sphere, stl"}},
    {14,
     "shapes = [{shape='sphere', center=[0,0,0], radius=0}]",
     {"case.toml:14: key 'region.0.shapes.0.radius'"}},
    {14,
     "shapes = [{shape='cylinder', start=[0,0,1], end=[0,0,1], radius=1}]",
     {"is the same point as start"}},
    {17, "shapes = [{shape='plane', point=[0,0,0], normal=[0,0,0]}]", {"case.toml:17", "has no direction"}},
    {17,
     "shapes = [\n{shape='stl', file='none.stl'}]",
     {"case.toml:18: key 'wall.0.shapes.0.file': value \"none.stl\" is not a file"}},
    {20,
     "max = [0.02, -0.01, 0.02]",
     {"case.toml:20: key 'domain.max': value -0.01 along y is not above domain.min"}},
    {20,
     "max = [0.02, 0.02, 0.02]\nperiodic = ['w']",
     {"case.toml:21: key 'domain.periodic': value \"w\" is not an axis: allowed: x, y, z"}},
    {20,
     "max = [0.0205, 0.02, 0.02]\nperiodic = ['x']",
     {"case.toml:21", "is 30.5 spacings", "whole number"}},
    {20,
     "max = [-0.003, 0.02, 0.02]\nperiodic = ['x']",
     {"case.toml:21", "too short", "3 support radii = 0.0078"}},
    {20,
     "max = [0.02, 0.02, 0.02]\nperiodic = ['z']",
     {"case.toml:29: key 'measure.0.direction': runs along the periodic axis z"}},
    {29,
     "position = 0.03",
     {"case.toml:29: key 'measure.0.position': value 0.03 is outside the domain: allowed: -0.01 to 0.02 "
      "[m]"}},
    {24,
     "end_time = 1\nstop_after = 'back'",
     {"case.toml:25: key 'output.stop_after': value \"back\" is no measure that arrives: allowed: a front or "
      "jet: front"}},
    {27,
     "type = 'jet'",
     {"key 'measure.0.lip': missing", "key 'measure.0.outward': missing", "key 'measure.0.bottom': missing",
      "key 'measure.0.direction': unknown"}},
    {4,
     "spacing = 1e-3\ndimensions = 2\n[body_force]\nacceleration = [0, 1, 0]",
     {"case.toml:7: key 'body_force.acceleration': y component 1.0 with two dimensions"}},
    // Limits
    {22, "[limits]\ninterval = 0", {"case.toml:23: key 'limits.interval'", "an integer from 1 to 1000"}},
    {22, "[limits]\nmax_speed = 0", {"case.toml:23: key 'limits.max_speed'", "or \"auto\""}},
    {22, "[limits]\nmax_speed = 'none'", {"value \"none\" has the wrong type"}},
    {22, "[limits]\nmax_compression = 1.5", {"case.toml:23", "allowed: a number > 0.0 and <= 1.0"}},
    {22, "[limits]\nmax_lost_fraction = -0.1", {"key 'limits.max_lost_fraction': value -0.1"}},
    {22, "[limits]\nmin_time_step_ratio = 2", {"key 'limits.min_time_step_ratio': value 2 is"}},
    {22, "[limits]\nmax_energy_growth = 0", {"key 'limits.max_energy_growth': value 0 is"}},
    {22, "[limits]\nmax_sped = 1", {"key 'limits.max_sped': unknown: did you mean 'max_speed'?"}},
    // Paths: what becomes a name of a file must not lead elsewhere
    {2, "name = 'a/b'", {"case.toml:2: key 'case.name': value \"a/b\" is not a name"}},
    {2, "name = '/etc/passwd'", {"value \"/etc/passwd\" is not a name"}},
    {2, "name = '.hidden'", {"value \".hidden\" is not a name"}},
    {2, "name = '-rf'", {"value \"-rf\" is not a name"}},
    {2, "name = \"a\\u0000b\"", {"case.toml:2"}},
    {2, "name = '" + std::string(101, 'a') + "'", {"is not a name: allowed: up to 100"}},
    {16, "name = '../wall'", {"case.toml:16: key 'wall.0.name': value \"../wall\" is not a name"}},
    {26, "name = 'a/../../b'", {"case.toml:26: key 'measure.0.name': value \"a/../../b\" is not a name"}},
    {7, "[fluid.'../x']", {"key 'fluid.../x': the name of a fluid"}},
    {17, "shapes = [{shape='stl', file='.'}]", {"case.toml:17", "is not a file that can be read"}},
    {17, "shapes = [{shape='stl', file='/dev/zero'}]", {"case.toml:17", "is not a file that can be read"}},
};

TEST(CaseErrors, TheUnchangedCaseIsAccepted) { EXPECT_EQ(message_of(text_with(0, "")), "accepted"); }

TEST(CaseErrors, AtLeastSixtyMistakesHaveMessagesOfTheirOwn) {
  std::set<std::string> messages;
  for (const Wrong& wrong : wrong_cases)
    messages.insert(message_of(text_with(wrong.line, wrong.replacement)));
  EXPECT_EQ(messages.count("accepted"), 0U);
  EXPECT_GE(messages.size(), 60U);
  EXPECT_EQ(messages.size(), wrong_cases.size()) << "two rows of the table are the same mistake";
}

TEST(CaseErrors, EachMistakeIsNamedWithItsPlace) {
  for (const Wrong& wrong : wrong_cases) {
    const std::string message = message_of(text_with(wrong.line, wrong.replacement));
    for (const std::string& fragment : wrong.fragments)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << "line " << wrong.line << ": " << wrong.replacement << "\nwanted: " << fragment
          << "\ngot: " << message;
  }
}

// The good case with another measure in place of its front.
std::string with_measure(const std::string& keys) {
  std::string text = text_with(27, keys);
  for (const std::string& line : {good_lines[27], good_lines[28]}) text.erase(text.rfind(line), line.size());
  return message_of(text);
}

TEST(CaseErrors, MeasuresMustFitTheDomain) {
  using testing::HasSubstr;
  EXPECT_EQ(with_measure("type = 'flow_rate'\ndirection = '+x'\nposition = 0.01"), "accepted");
  EXPECT_THAT(with_measure("type = 'flow_rate'\ndirection = '+x'\nposition = 0.01\nfraction = 0.1"),
              HasSubstr("key 'measure.0.fraction': unknown"));
  EXPECT_THAT(with_measure("type = 'flow_rate'\ndirection = '+x'\nposition = 1"),
              HasSubstr("key 'measure.0.position': value 1.0 is outside the domain"));
  EXPECT_EQ(with_measure("type = 'volume'\nmin = [0, 0, 0]\nmax = [0.01, 9, 9]"), "accepted");
  EXPECT_THAT(with_measure("type = 'volume'\nmin = [0, 0, 0]\nmax = [0.01, 0, 0.01]"),
              HasSubstr("key 'measure.0.max': value 0.0 along y is not above min"));
  EXPECT_THAT(with_measure("type = 'volume'\nmin = [1, 0, 0]\nmax = [2, 1, 1]"),
              HasSubstr("outside of the domain"));
  EXPECT_EQ(with_measure("type = 'profile'\nstart = [0, 0, 0]\nend = [0, 0, 0.01]"), "accepted");
  EXPECT_THAT(with_measure("type = 'profile'\nstart = [0, 0, 0]\nend = [0, 0, 0]"),
              HasSubstr("key 'measure.0.end': is the start"));
  EXPECT_THAT(with_measure("type = 'profile'\nstart = [0, 0, 1]\nend = [0, 0, 0]\npoints = 1"),
              AllOf(HasSubstr("key 'measure.0.start': value [0.0, 0.0, 1.0] is outside the domain"),
                    HasSubstr("key 'measure.0.points': value 1")));
}

TEST(CaseErrors, JetMustPointDownAndOut) {
  const auto jet = [](const std::string& outward, const std::string& bottom) {
    std::string text =
        text_with(27, "type = 'jet'\nlip = [0,0,0]\noutward = '" + outward + "'\nbottom = " + bottom);
    for (const std::string& line : {good_lines[27], good_lines[28]}) text.erase(text.find(line), line.size());
    return message_of(text);
  };
  EXPECT_EQ(jet("+x", "-0.005"), "accepted");
  EXPECT_NE(jet("+z", "-0.005").find("key 'measure.0.outward': runs along gravity"), std::string::npos);
  EXPECT_NE(jet("+x", "0.005").find("key 'measure.0.bottom': value 0.005 is not below the lip"),
            std::string::npos);
}

TEST(CaseErrors, AllMistakesAreReportedOneALineInTheirOrder) {
  std::string text = text_with(8, "density = -3");
  text.replace(text.find("courant = 0.5"), 13, "courant = 7\nfoo = 1");
  const std::string message = message_of(text);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
  const auto density = message.find("case.toml:8:"), courant = message.find("\ncase.toml:22:"),
             unknown = message.find("\ncase.toml:23:");
  EXPECT_LT(density, courant);
  EXPECT_LT(courant, unknown);
  EXPECT_NE(unknown, std::string::npos);
}

TEST(CaseErrors, OverridesAreNamedInPlaceOfTheLine) {
  const std::string good = text_with(0, "");
  EXPECT_NE(
      message_of(good, {"fluid.slag.yield_stress=-5"})
          .find("--set fluid.slag.yield_stress=-5: key 'fluid.slag.yield_stress': value -5 is out of range"),
      std::string::npos);
  EXPECT_NE(
      message_of(good, {"numerics.solver=sorr"}).find("--set numerics.solver=sorr: key 'numerics.solver'"),
      std::string::npos);
  EXPECT_NE(message_of(good, {"region.1.velocity=[0,0,0]"})
                .find("'1' is not an entry of this list: allowed: 0 to 0"),
            std::string::npos);
  EXPECT_NE(message_of(good, {"case.name.x=1"}).find("cannot be set inside the value \"tank\""),
            std::string::npos);
  EXPECT_NE(message_of(good, {"spacing"}).find("--set spacing: allowed: --set dotted.key=value"),
            std::string::npos);
  EXPECT_NE(message_of(good, {"foo.bar=1"}).find("--set foo.bar=1: key 'foo': unknown"), std::string::npos);
  EXPECT_NE(message_of(good, {"case..name=1"}).find("empty part"), std::string::npos);
}

TEST(CaseErrors, AMessageStaysOnOneLineWhateverTheKeyHolds) {
  const std::string message = message_of(text_with(22, "\"a\\nb\" = 1"));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_NE(message.find("a?b"), std::string::npos) << message;
}

TEST(CaseErrors, AMissingFileIsNamed) {
  EXPECT_THROW(load_case(testing::TempDir() + "no_such_case.toml"), InputError);
  EXPECT_THROW(load_case(testing::TempDir()), InputError);
}

TEST(CaseErrors, GarbageIsRefused) {
  for (const std::string& text : {std::string("\xff\xfe\x00\x01", 4), std::string(), std::string(5000, 'a'),
                                  "a" + std::string(200, '.'), std::string("= = =")})
    EXPECT_NE(message_of(text), "accepted");
}

}  // namespace
}  // namespace slagflow
