// Motions from CSV files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/case/motion_file.hpp"
#include "host/temp_folder.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::TempFolder;

struct Read {
  WallMotion motion;
  std::string fault;
};

Read read(const std::string& text) {
  const TempFolder folder;
  std::ofstream(folder / "m.csv") << text;
  Read result;
  result.fault = read_motion_file(folder / "m.csv", result.motion);
  return result;
}

TEST(MotionFile, IsReadWithItsUnits) {
  const Read r = read("# tilt of the ladle\ntime_ms,x_mm,note,angle_deg\n0,5,a,10\n500,7.5,b,100\n");
  EXPECT_EQ(r.fault, "");
  EXPECT_EQ(r.motion.time, (std::vector<double>{0, 0.5}));
  EXPECT_NEAR(r.motion.displacement[1].x, 2.5e-3, 1e-15);  // from the first row
  EXPECT_NEAR(r.motion.angle[1], std::acos(-1.0) / 2, 1e-12);
}

TEST(MotionFile, RefusesNumbersThatItDoesNotUnderstand) {
  for (const std::string name : {"Winkel [gon]", "Kippwinkel [deg]", "angle", "y [inch]", "Hub [mm]"})
    EXPECT_THAT(read("time_s;x_mm;" + name + "\n0;0;0\n1;5;10\n").fault,
                HasSubstr("line 1: '" + name + "' is no motion with a unit that is known: allowed: "));
}

TEST(MotionFile, OtherEditorsWriteItOtherwise) {
  const Read r = read("\xEF\xBB\xBF\"Time [s]\";\"Angle (deg)\"\r\n0;0\r\n\r\n1,5;90\r\n");
  EXPECT_EQ(r.fault, "");
  EXPECT_EQ(r.motion.time, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(r.motion.angle.size(), 2U);
  EXPECT_TRUE(read("t / s\tz / cm\n0\t0\n2\t3\n").motion.angle.empty());
}

// As Excel saves it: "Unicode text", and the CSV of a German Windows with ° of its code page.
TEST(MotionFile, EncodingsAreThoseOfRheometers) {
  std::string utf16 = "\xFF\xFE";
  for (const char c : std::string("Zeit [s]\tWinkel [deg]\r\n0\t0\r\n1,5\t90\r\n")) utf16 += {c, '\0'};
  const std::string windows =
      "Zeit;Winkel;Bemerkung\r\ns;\xB0;\r\n0;0;\r\n\"1,5\";90,0;F\xFC"
      "llung\r\n";
  for (const std::string& text : {utf16, windows}) {
    const Read r = read(text);
    EXPECT_EQ(r.fault, "");
    EXPECT_EQ(r.motion.time, (std::vector<double>{0, 1.5}));
    ASSERT_EQ(r.motion.angle.size(), 2U);
    EXPECT_NEAR(r.motion.angle[1], std::acos(-1.0) / 2, 1e-12);
  }
  EXPECT_THAT(read(std::string("PK\x03\x04", 4)).fault, HasSubstr("the file is a spreadsheet (.xlsx, .ods)"));
}

TEST(MotionFile, LinesAboveTheNamesAreLeftOut) {
  const Read r = read("sep=;\nTilt of ladle 3\ntime;z\ns;mm\n0;0\n2;5,5\n");
  EXPECT_EQ(r.fault, "");
  EXPECT_EQ(r.motion.time, (std::vector<double>{0, 2}));
  EXPECT_NEAR(r.motion.displacement[1].z, 5.5e-3, 1e-15);
}

TEST(MotionFile, SignsOfNumbersAreNotGuessed) {
  EXPECT_EQ(read("time_s,x_m\n0,0\n\"1,25\",\"0,5\"\n").motion.time, (std::vector<double>{0, 1.25}));
  EXPECT_EQ(read("time_s;x_m\n0;0\n1,250;2\n").motion.time, (std::vector<double>{0, 1.25}));
  EXPECT_EQ(read("time_s;x_m\n0.5;0\n1,250;2\n").fault,
            "line 3: '1,250' has a comma, '0.5' in line 2 a decimal point: allowed: one of them, and none "
            "between thousands");
  EXPECT_THAT(read("time_s;x_m\n0,5;0\n1.250;2\n").fault, HasSubstr("line 3: '1.250' has a point"));
  EXPECT_EQ(read("time_s;x_m\n0;\"0\n").fault, "line 2: a quote that is not closed: allowed: \" in pairs");
}

TEST(MotionFile, FaultsAreToldWithTheirLine) {
  EXPECT_EQ(read("time_s,x_m\n0,0\n1,abc\n").fault, "line 3: 'abc' is not a number");
  EXPECT_EQ(read("time_s,x_m\n0,0\n1\n").fault, "line 3: '' is not a number");
  EXPECT_THAT(read("time_s,angle_deg\n0,0\n1,5,10,5\n").fault,
              HasSubstr("line 3: has 4 fields, the line of names 2: allowed: as many"));
  EXPECT_EQ(read("time_s,angle_deg\n0,0,,\n1,5,\n").fault, "");
  EXPECT_THAT(read("time,x_m\n0,0\n").fault, HasSubstr("line 1: has no time with its unit: allowed: a line"));
  EXPECT_THAT(read("time_s,x\n0,0\n").fault,
              HasSubstr("has neither a displacement nor an angle with its unit"));
  EXPECT_THAT(read("time_s,x_m,dx_mm\n").fault, HasSubstr("'dx_mm' is the second of its kind"));
  EXPECT_EQ(read("").fault, "has no line of column names");
  WallMotion none;
  EXPECT_EQ(read_motion_file("/nowhere/m.csv", none), "cannot be read");
}

TEST(MotionFile, StandsInPlaceOfRowsInACase) {
  const TempFolder folder;
  std::ofstream(folder / "tilt.csv") << "time_s,angle_deg\n0,0\n2,45\n";
  const auto text = [](const std::string& motion) {
    return "[case]\nname='a'\n[resolution]\nspacing=0.1\n[fluid.w]\ndensity=1000\nrheology='newtonian'\n"
           "dynamic_viscosity=1\n[[region]]\nshapes=[{shape='box', min=[0,0,0], "
           "max=[1,1,1]}]\n[[wall]]\nname='w'\n"
           "shapes=[{shape='box', min=[0,0,0], max=[1,1,1]}]\nmotion={type='table', " +
           motion + "}\n[domain]\nmin=[0,0,0]\nmax=[1,1,1]\n[output]\nend_time=1\n";
  };
  const std::string file = folder / "case.toml";
  const Case c = parse_case(text("file='tilt.csv', axis=[0,1,0]"), file);
  EXPECT_EQ(c.walls[0].motion.time, (std::vector<double>{0, 2}));
  EXPECT_NEAR(c.walls[0].motion.angle[1], std::acos(-1.0) / 4, 1e-12);
  // A resolved case holds the rows and needs no file.
  EXPECT_THAT(to_toml(c), testing::Not(HasSubstr("tilt.csv")));
  EXPECT_EQ(to_toml(parse_case(to_toml(c), "elsewhere.toml")), to_toml(c));
  const auto message = [&](const std::string& motion) {
    try {
      parse_case(text(motion), file);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(message("file='tilt.csv', time=[0,1], axis=[0,1,0]"),
              HasSubstr("key 'wall.0.motion.time': stands beside file: allowed: one of them"));
  EXPECT_THAT(message("file='gone.csv', axis=[0,1,0]"),
              HasSubstr("key 'wall.0.motion.file': value \"gone.csv\": cannot be read"));
  EXPECT_THAT(message("file='tilt.csv'"), HasSubstr("key 'wall.0.motion.axis': missing"));
  EXPECT_THAT(message("axis=[0,1,0]"), HasSubstr("key 'wall.0.motion.time': missing"));
}

}  // namespace
}  // namespace slagflow
