// [[inlet]] and [[outlet]] of a case: read, resolved, refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/case/case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;

std::string text(const std::string& inlet, const std::string& more = "") {
  return R"([case]
name = "fed"
[resolution]
spacing = 0.01
[fluid.slag]
density = 2000
rheology = "newtonian"
dynamic_viscosity = 1
[[inlet]]
)" + inlet +
         R"(
[domain]
min = [0, 0, 0]
max = [1, 1, 1]
[output]
end_time = 1
)" + more;
}

const std::string disc = "name='tap'\nface='disc'\ncenter=[0.5,0.5,0.8]\nradius=0.1\nnormal=[0,0,-2]\n";

std::string message_of(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(CaseOpenings, AreRead) {
  const Case c = parse_case(text(disc + "mass_flow=[[0,0],[1.5,3]]\nstart=0.5\nstop=9\nprofile='developed'",
                                 "[[outlet]]\nname='end'\nshape='plane'\ndirection='-z'\nposition=0.1\n"
                                 "[[outlet]]\nname='drain'\nshape='box'\nmin=[0,0,0]\nmax=[1,1,0.1]\n"),
                            "case.toml");
  ASSERT_EQ(c.inlets.size(), 1U);
  const InletSpec& in = c.inlets[0];
  EXPECT_EQ(in.name, "tap");
  EXPECT_EQ(in.face, InletFace::disc);
  EXPECT_EQ(in.feed, InletFeed::mass_flow);
  ASSERT_EQ(in.rows.size(), 2U);
  EXPECT_EQ(in.rows[1], (std::array<double, 2>{1.5, 3}));
  EXPECT_EQ(in.profile, InletProfile::developed);
  EXPECT_DOUBLE_EQ(in.stop, 9);
  ASSERT_EQ(c.outlets.size(), 2U);
  EXPECT_EQ(c.outlets[0].shape, OutletShape::plane);
  EXPECT_EQ(c.outlets[0].direction.axis, 2);
  EXPECT_DOUBLE_EQ(c.outlets[1].max.z, 0.1);
  // The resolved case says the same.
  const std::string resolved = to_toml(c);
  EXPECT_EQ(to_toml(parse_case(resolved, "case.toml")), resolved);
  EXPECT_THAT(resolved, HasSubstr("mass_flow = [[0.0, 0.0], [1.5, 3.0]]"));
  EXPECT_THAT(resolved, testing::Not(HasSubstr("volume_flow")));
}

TEST(CaseOpenings, AFlowIsAskedForOnceInOneWay) {
  EXPECT_THAT(
      message_of(text(disc)),
      HasSubstr("key 'inlet.0': has none of velocity, volume_flow and mass_flow: allowed: one of them"));
  EXPECT_THAT(message_of(text(disc + "velocity=1\nmass_flow=2")), HasSubstr("has more than one of velocity"));
  EXPECT_THAT(message_of(text(disc + "velocity=-1")), HasSubstr("key 'inlet.0.velocity': value -1"));
  EXPECT_THAT(
      message_of(text(disc + "velocity=[[0,1],[0,2]]")),
      HasSubstr(
          "case.toml:15: key 'inlet.0.velocity': time 0.0 follows 0.0: allowed: rows [time [s], value]"));
  EXPECT_THAT(message_of(text(disc + "velocity=[[0,-1]]")), HasSubstr("row [0.0, -1.0] is out of range"));
  EXPECT_THAT(message_of(text(disc + "velocity=[]")), HasSubstr("value [] is empty"));
}

TEST(CaseOpenings, AFlowOfTheCommandLineTakesThePlaceOfTheFiles) {
  const std::string file = text(disc + "velocity=[[0,0],[1,2]]");
  const Case c = parse_case(file, "case.toml", {"inlet.0.mass_flow=3"});
  EXPECT_EQ(c.inlets[0].feed, InletFeed::mass_flow);
  EXPECT_DOUBLE_EQ(c.inlets[0].value, 3);
  EXPECT_TRUE(c.inlets[0].rows.empty());
  EXPECT_THAT(to_toml(c), testing::Not(HasSubstr("velocity = [[")));
  EXPECT_EQ(parse_case(file, "case.toml", {"inlet.0.velocity=4"}).inlets[0].feed, InletFeed::velocity);
  try {
    parse_case(file, "case.toml", {"inlet.0.mass_flow=3", "inlet.0.volume_flow=1"});
    FAIL() << "two flows of the command line";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("has more than one of velocity"));
  }
}

TEST(CaseOpenings, KeysGoWithTheirFace) {
  EXPECT_THAT(message_of(text(disc + "velocity=1\nwidth=1")),
              HasSubstr("width goes with face = \"rectangle\", dimensions = 3"));
  EXPECT_THAT(message_of(text("name='a'\nface='annulus'\ncenter=[0,0,0]\nradius=1\ninner_radius=2\n"
                              "normal=[1,0,0]\nvelocity=1")),
              HasSubstr("key 'inlet.0.inner_radius': value 2.0 is not below radius: allowed: < 1.0 [m]"));
  EXPECT_THAT(
      message_of(text("name='a'\nface='rectangle'\ncenter=[0,0,0]\nheight=1\nnormal=[1,0,0]\nvelocity=1")),
      HasSubstr("key 'inlet.0.width': missing"));
  EXPECT_THAT(message_of(text("name='a'\nface='disk'\n")), HasSubstr("did you mean 'disc'?"));
  std::string flat = disc;
  flat.replace(flat.find("[0,0,-2]"), 8, "[0,0,0] ");
  EXPECT_THAT(message_of(text(flat + "velocity=1")), HasSubstr("value [0, 0, 0] has no direction"));
  EXPECT_THAT(message_of(text(disc + "velocity=1\nstart=3\nstop=2")),
              HasSubstr("key 'inlet.0.stop': value 2 is out of range: allowed: a number > 3.0"));
}

TEST(CaseOpenings, WithTwoDimensionsARectangleHasAHeightAlone) {
  const auto flat = [](const std::string& inlet) {
    std::string all = text(inlet);
    return all.insert(all.find("spacing"), "dimensions = 2\n");
  };
  const std::string slot =
      "name='a'\nface='rectangle'\ncenter=[0,0,0.5]\nheight=1\nnormal=[1,0,0]\nvelocity=1\n";
  EXPECT_EQ(message_of(flat(slot)), "no error");
  EXPECT_THAT(message_of(flat(slot + "width=1")),
              HasSubstr("width goes with face = \"rectangle\", dimensions = 3"));
  EXPECT_THAT(message_of(flat(disc + "velocity=1")),
              HasSubstr("key 'inlet.0.face': value \"disc\" with two dimensions: allowed: rectangle"));
  std::string oblique = slot;
  oblique.replace(oblique.find("[1,0,0]"), 7, "[1,1,0]");
  EXPECT_THAT(message_of(flat(oblique)),
              HasSubstr("key 'inlet.0.normal': y component 1.0 with two dimensions"));
}

TEST(CaseOpenings, NamesAreTheirOwn) {
  const std::string wall = "[[wall]]\nname='tap'\nshapes=[{shape='plane', point=[0,0,0], normal=[0,0,1]}]\n";
  EXPECT_THAT(
      message_of(text(disc + "velocity=1", wall)),
      HasSubstr("key 'inlet.0.name': value \"tap\" is the name of a wall: allowed: a name of its own"));
  EXPECT_THAT(message_of(text(disc + "velocity=1\n[[inlet]]\n" + disc + "velocity=1")),
              HasSubstr("value \"tap\" is given twice"));
}

TEST(CaseOpenings, WithoutRegionOrInletThereIsNoFluid) {
  std::string none = text("");
  none.erase(none.find("[[inlet]]\n"), 10);
  EXPECT_THAT(message_of(none),
              HasSubstr("key 'region': missing: required: at least one [[region]] or [[inlet]]"));
}

TEST(CaseOpenings, OutletsOutsideTheDomainAreRefused) {
  const std::string out = "[[outlet]]\nname='end'\nshape='plane'\ndirection='-z'\nposition=";
  EXPECT_EQ(message_of(text(disc + "velocity=1", out + "0.1\n")), "no error");
  EXPECT_THAT(
      message_of(text(disc + "velocity=1", out + "-0.1\n")),
      HasSubstr("key 'outlet.0.position': value -0.1 leaves nothing of the domain beyond: allowed: > 0.0"));
  EXPECT_THAT(message_of(text(disc + "velocity=1",
                              "[[outlet]]\nname='end'\nshape='box'\nmin=[2,0,0]\nmax=[3,1,1]\n")),
              HasSubstr("makes a box outside of the domain"));
}

}  // namespace
}  // namespace slagflow
