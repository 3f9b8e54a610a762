// Reading a case: values, defaults, overrides, and writing it back.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "backend/error.hpp"
#include "host/case/case.hpp"

namespace slagflow {
namespace {

const char* const minimal = R"(
[case]
name = "small"
[resolution]
spacing = 1e-3
[fluid.oil]
density = 965
rheology = "newtonian"
dynamic_viscosity = 0.1
[[region]]
shapes = [{shape="sphere", center=[0,0,0], radius=0.005}]
[domain]
min = [-0.01, -0.01, -0.01]
max = [0.01, 0.01, 0.01]
[output]
end_time = 2
)";

const char* const rich = R"(
[case]
name = "rich"
description = "quotes \" and\nlines \\ and a tab\t"
[resolution]
spacing = 0.0033333333333333335
support_ratio = 2.1
origin = [0.1, 0.2, 1e-7]
[gravity]
acceleration = [0.1, 0, -3]
[body_force]
acceleration = [0, 1e-300, 4]
[fluid.zinc]
density = 7000
rheology = "newtonian"
dynamic_viscosity = 3.1e-3
[fluid.slag]
density = 2600
rheology = "bingham"
plastic_viscosity = 2.25
yield_stress = 2.3
growth_exponent = 123.456789
[[region]]
fluid = "slag"
shapes = [
  {shape="box", min=[0,0,0], max=[0.1,0.1,0.1]},
  {shape="cylinder", start=[0,0,0], end=[0,0,0.05], radius=0.02},
]
subtract = [{shape="sphere", center=[0.05,0.05,0.05], radius=0.01}]
velocity = [1, 2, 3]
angular_velocity = [0.1, 0, 0]
center = [0, 0.5, 0]
pressure = "zero"
[[region]]
fluid = "zinc"
shapes = [{shape="plane", point=[0,0,-0.01], normal=[0,0.6,0.8]}]
[[wall]]
name = "ladle"
slip = "free_slip"
shapes = [{shape="box", min=[-1,-1,-1], max=[1,1,1], outside=true}]
[domain]
min = [-0.1, -0.1, -0.1]
max = [0.1, 0.1, 0.2]
periodic = ["x", "y"]
departure = "stop"
[numerics]
solver = "sor"
sound_speed = 12
theta = 0.5
tolerance = 1e-5
max_iterations = 17
[output]
end_time = 0.3
interval = 0.017
walls = false
[[measure]]
name = "a"
type = "front"
direction = "+z"
position = 0.1
fraction = 0.3
[[measure]]
name = "b"
type = "jet"
lip = [0, 0, 0]
outward = "-x"
bottom = -0.1
)";

TEST(CaseFile, FillsInDefaults) {
  const Case c = parse_case(minimal, "small.toml");
  EXPECT_EQ(c.name, "small");
  EXPECT_EQ(c.support_ratio, 2.6);
  EXPECT_EQ(c.dimensions, 3);
  EXPECT_TRUE(c.gravity == (Vec3d{0, 0, -9.81}));
  EXPECT_EQ(c.regions.at(0).fluid, 0);
  EXPECT_EQ(c.regions.at(0).pressure, InitialPressure::hydrostatic);
  EXPECT_EQ(c.domain.departure, Departure::remove);
  EXPECT_EQ(c.numerics.sound_speed, 0);
  EXPECT_EQ(c.numerics.solver, ViscousSolver::multigrid);
  EXPECT_EQ(c.numerics.solver_loop, SolverLoop::batch);
  EXPECT_DOUBLE_EQ(c.output.interval, 2.0 / 50);
  EXPECT_DOUBLE_EQ(c.output.history_interval, 2.0 / 500);
  EXPECT_TRUE(c.output.walls);
  EXPECT_TRUE(c.walls.empty());
}

TEST(CaseFile, ReadsEveryTable) {
  const Case c = parse_case(rich, "rich.toml");
  ASSERT_EQ(c.fluids.size(), 2u);
  EXPECT_EQ(c.fluids[0].name, "zinc");  // order of the file, not of the alphabet
  EXPECT_EQ(c.fluids[1].parameters[2], 123.456789);
  EXPECT_EQ(c.regions.at(0).fluid, 1);
  EXPECT_EQ(c.regions.at(0).shapes.size(), 2u);
  EXPECT_EQ(std::get<SphereSpec>(c.regions.at(0).subtract.at(0).form).radius, 0.01);
  EXPECT_TRUE(c.walls.at(0).shapes.at(0).outside);
  EXPECT_EQ(c.walls.at(0).slip, WallSlip::free_slip);
  EXPECT_TRUE(c.domain.periodic[0] && c.domain.periodic[1] && !c.domain.periodic[2]);
  EXPECT_EQ(c.domain.departure, Departure::stop);
  EXPECT_EQ(c.numerics.solver, ViscousSolver::sor);
  EXPECT_EQ(c.numerics.max_iterations, 17);
  EXPECT_EQ(c.measures.at(0).direction.axis, 2);
  EXPECT_EQ(c.measures.at(0).direction.sign, 1);
  EXPECT_EQ(c.measures.at(1).outward.axis, 0);
  EXPECT_EQ(c.measures.at(1).outward.sign, -1);
  EXPECT_DOUBLE_EQ(c.output.history_interval, 0.0017);
}

TEST(CaseFile, KnowsWhereKeysStand) {
  const Case c = parse_case(minimal, "small.toml", {"numerics.sound_speed=3"});
  EXPECT_EQ(c.place_of("resolution.spacing"), "small.toml:5");
  EXPECT_EQ(c.place_of("region.0.velocity"), "small.toml:10");
  EXPECT_EQ(c.place_of("numerics.sound_speed"), "--set numerics.sound_speed=3");
  EXPECT_EQ(c.place_of("wall.0"), "small.toml");
}

TEST(CaseFile, WrittenCaseIsTheSameCase) {
  for (const char* text : {minimal, rich}) {
    const Case c = parse_case(text, "a.toml");
    const std::string written = to_toml(c);
    const Case again = parse_case(written, "b.toml");
    EXPECT_EQ(written, to_toml(again));
    EXPECT_EQ(c.spacing, again.spacing);
    EXPECT_EQ(c.description, again.description);
    EXPECT_EQ(c.fluids.back().parameters, again.fluids.back().parameters);
    EXPECT_EQ(c.numerics.sound_speed, again.numerics.sound_speed);
    EXPECT_EQ(c.body_force.y, again.body_force.y);
    EXPECT_EQ(c.measures.size(), again.measures.size());
  }
}

TEST(CaseFile, WrittenCaseHoldsTheLoopOfTheSolver) {
  const std::string written = to_toml(parse_case(minimal, "a.toml", {"numerics.solver_loop=conditional"}));
  EXPECT_EQ(parse_case(written, "b.toml").numerics.solver_loop, SolverLoop::conditional);
}

std::string message_of(const std::vector<std::string>& overrides) {
  try {
    parse_case(minimal, "a.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Key and value beside it, and what the message says of it.
TEST(CaseFile, TheLoopOfTheSolverIsTheDevicesForSomeSolversOnly) {
  struct Other {
    const char *set, *said;
  };
  for (const Other& other : {Other{"numerics.solver=sor", "numerics.solver = \"sor\""},
                             Other{"numerics.solver=jacobi", "numerics.solver = \"jacobi\""},
                             Other{"numerics.scheme=paper", "numerics.solver = \"sor\""},
                             Other{"numerics.viscous_step=explicit", "numerics.viscous_step = \"explicit\""},
                             Other{"numerics.yield=exact", "numerics.yield = \"exact\""}}) {
    EXPECT_NO_THROW(parse_case(minimal, "a.toml", {"numerics.solver_loop=batch", other.set}));
    const std::string message = message_of({"numerics.solver_loop=conditional", other.set});
    EXPECT_NE(message.find("key 'numerics.solver_loop': value \"conditional\" with " +
                           std::string(other.said) + ": allowed: \"batch\""),
              std::string::npos)
        << message;
  }
  EXPECT_NE(message_of({"numerics.solver_loop=while"}).find("allowed: batch, conditional"),
            std::string::npos);
}

TEST(CaseFile, WrittenCaseHoldsTheDefaults) {
  const std::string written = to_toml(parse_case(minimal, "a.toml"));
  for (const char* line :
       {"support_ratio = 2.6", "sound_speed = \"auto\"", "anti_pairing = \"auto\"", "kernel = \"level\"",
        "tension = \"viscous\"", "viscous_weight = \"lattice\"", "shifting = \"auto\"", "interval = 0.04",
        "fluid = \"oil\"", "periodic = []", "departure = \"remove\"", "skin = 0.06"})
    EXPECT_NE(written.find(line), std::string::npos) << line << "\n" << written;
}

TEST(CaseFile, OverridesReachTablesAndLists) {
  const Case c =
      parse_case(rich, "rich.toml",
                 {"fluid.slag.yield_stress=5", "region.1.velocity=[0,0,-1]", "numerics.solver=jacobi",
                  "wall.0.shapes.0.max=[1,1,2]", "fluid.new.density=1", "fluid.new.rheology=newtonian",
                  "fluid.new.dynamic_viscosity=2", "case.name=other", "output.walls=true",
                  "numerics.theta=0.75", "numerics.theta=1"});
  EXPECT_EQ(c.fluids[1].parameters[1], 5);
  EXPECT_EQ(c.regions[1].velocity.z, -1);
  EXPECT_EQ(c.numerics.solver, ViscousSolver::jacobi);
  EXPECT_EQ(std::get<BoxSpec>(c.walls[0].shapes[0].form).max.z, 2);
  EXPECT_EQ(c.fluids.at(2).name, "new");
  EXPECT_EQ(c.name, "other");
  EXPECT_TRUE(c.output.walls);
  EXPECT_EQ(c.numerics.theta, 1);  // the last one holds
}

TEST(CaseFile, SchemePaperIsThePapersViscousStep) {
  const NumericsSetup n = parse_case(minimal, "a.toml", {"numerics.scheme=paper"}).numerics;
  EXPECT_EQ(n.viscous_operator, ViscousOperator::laplacian);
  EXPECT_EQ(n.explicit_part, ExplicitPart::predicted);
  EXPECT_EQ(n.viscous_step, ViscousStepping::implicit_step);
  EXPECT_EQ(n.theta, 0.5);
  EXPECT_EQ(n.solver, ViscousSolver::sor);
  EXPECT_EQ(n.viscosity_correction, 1);
  const NumericsSetup ours = parse_case(minimal, "a.toml", {"numerics.scheme=slagflow"}).numerics;
  EXPECT_EQ(ours.viscous_operator, ViscousOperator::radial);
  EXPECT_EQ(ours.explicit_part, ExplicitPart::old_velocity);
  EXPECT_EQ(ours.theta, 1);
  EXPECT_EQ(ours.viscosity_correction, 0);
}

TEST(CaseFile, GivenKeysGoBeforeTheScheme) {
  const NumericsSetup n =
      parse_case(minimal, "a.toml",
                 {"numerics.scheme=paper", "numerics.operator=radial", "numerics.explicit_part=old_velocity",
                  "numerics.theta=0.75", "numerics.solver=jacobi", "numerics.viscosity_correction=auto"})
          .numerics;
  EXPECT_EQ(n.viscous_operator, ViscousOperator::radial);
  EXPECT_EQ(n.explicit_part, ExplicitPart::old_velocity);
  EXPECT_EQ(n.theta, 0.75);
  EXPECT_EQ(n.solver, ViscousSolver::jacobi);
  EXPECT_EQ(n.viscosity_correction, 0);
}

TEST(CaseFile, AWrittenCaseHoldsTheKeysOfItsScheme) {
  const std::string written = to_toml(parse_case(minimal, "a.toml", {"numerics.scheme=paper"}));
  const NumericsSetup again = parse_case(written, "b.toml").numerics;
  EXPECT_EQ(again.viscous_operator, ViscousOperator::laplacian);
  EXPECT_EQ(again.explicit_part, ExplicitPart::predicted);
  EXPECT_EQ(again.theta, 0.5);
  EXPECT_EQ(again.solver, ViscousSolver::sor);
  EXPECT_EQ(again.viscosity_correction, 1);
}

TEST(CaseFile, ReadsEveryRheologyOfTheTable) {
  for (const RheologyInfo& info : rheologies) {
    std::string text = minimal;
    const std::string old = "rheology = \"newtonian\"\ndynamic_viscosity = 0.1\n";
    std::string keys = "rheology = \"" + std::string(info.name) + "\"\n";
    std::array<double, most_parameters> expected{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(info.parameter_count); ++k) {
      const ParameterInfo& p = info.parameters[k];
      expected[k] = p.fallback < 0 ? std::min(static_cast<double>(k + 1), p.upper) : p.fallback;
      if (p.fallback < 0) keys += std::string(p.key) + " = " + std::to_string(expected[k]) + "\n";
    }
    text.replace(text.find(old), old.size(), keys);
    const Case c = parse_case(text, "a.toml");
    EXPECT_STREQ(c.fluids[0].info().name, info.name);
    EXPECT_EQ(c.fluids[0].parameters, expected) << info.name;
    EXPECT_EQ(parse_case(to_toml(c), "b.toml").fluids[0].parameters, expected) << info.name;
  }
}

TEST(CaseFile, StlPathsAreRelativeToTheCaseAndWrittenAbsolute) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "case_with_stl";
  std::filesystem::create_directories(folder / "parts");
  std::ofstream(folder / "parts" / "x.stl") << "solid\nendsolid\n";
  std::string text = minimal;
  text += "[[wall]]\nname='w'\nshapes=[{shape='stl', file='parts/x.stl', scale=1e-3}]\n";
  std::ofstream(folder / "case.toml") << text;
  const Case c = load_case((folder / "case.toml").string());
  EXPECT_EQ(std::get<StlSpec>(c.walls[0].shapes[0].form).file, (folder / "parts" / "x.stl").string());
  const Case moved = parse_case(to_toml(c), testing::TempDir() + "elsewhere/case.toml");
  EXPECT_EQ(to_toml(moved), to_toml(c));
}

TEST(CaseFile, GravityDirectionIsItsLargestComponent) {
  Case c;
  c.gravity = {0, 0, -9.81};
  EXPECT_EQ(down(c).axis, 2);
  EXPECT_EQ(down(c).sign, -1);
  c.gravity = {5, -8, 1};
  EXPECT_EQ(down(c).axis, 1);
  EXPECT_EQ(down(c).sign, -1);
}

}  // namespace
}  // namespace slagflow
