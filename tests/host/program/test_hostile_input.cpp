// Input that means harm or is far beyond reason: files that shapes name, overrides, paths and sizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/program/program.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

std::string facet(const std::string& corners) {
  return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
}
const std::string flat = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
const std::string back = facet("vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n");

// A binary file that announces some triangles and holds others.
std::string binary(std::uint32_t announced, const std::vector<std::array<float, 9>>& triangles) {
  std::string bytes(84, '\0');
  std::memcpy(&bytes[80], &announced, sizeof announced);
  for (const auto& corners : triangles) {
    std::string triangle(50, '\0');
    std::memcpy(&triangle[12], corners.data(), sizeof corners);
    bytes += triangle;
  }
  return bytes;
}

struct WrongSurface {
  std::string bytes, fragment;
};

const std::vector<WrongSurface> wrong_surfaces{
    {"", "0 bytes, too short for an STL file"},
    {std::string(83, '\0'), "83 bytes, too short for an STL file"},
    {"PNG and more of the same, which is surely no surface at all, however long one reads on and on ....",
     "but its header announces"},
    {binary(0, {}), "holds no triangle"},
    {binary(4, {{}}), "134 bytes, but its header announces 4 triangles = 284 bytes"},
    {binary(4294967295u, {}), "84 bytes, but its header announces 4294967295 triangles"},
    {binary(1, {{0, 0, 0, 1, 0, 0, NAN, 1, 0}}), "triangle 0 has a coordinate that is not a number"},
    {binary(1, {{0, 0, 0, 1, 0, 0, INFINITY, 1, 0}}), "triangle 0 has a coordinate that is not a number"},
    {binary(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 3e38f, 0}}),
     "triangle 1 has a coordinate that is not a number or beyond 1e30"},
    {binary(1, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}), "the surface is not closed: 3 open edges"},
    {binary(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 1, 0}}),
     "do not agree which side is outside"},
    {binary(1, {{5, 5, 5, 5, 5, 5, 5, 5, 5}}), "no triangle has an area"},
    {"solid", "'facet' or 'endsolid' expected, found the end of the file"},
    {"solid x\nendsolid x\n", "holds no triangle"},
    {"solid x\nfacet\n", ":3: 'normal' expected, found the end of the file"},
    {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", ":4: a number expected, found 'zero'"},
    {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
     ":6: 'vertex' expected, found 'endloop'"},
    {"solid x\n" + flat, "'facet' or 'endsolid' expected, found the end of the file"},
    {"solid x\n" + flat + "endsolid\nrubbish\n", "'solid' expected, found 'rubbish'"},
    {"solid x\n" + facet("vertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\n") + "endsolid\n",
     "triangle 0 has a coordinate that is not a number"},
    {"solid x\n" + facet("vertex 1e400 0 0\nvertex 1 0 0\nvertex 0 1 0\n") + "endsolid\n",
     "triangle 0 has a coordinate that is not a number"},
    {"solid x\n" + flat + back + "endsolid\n", "the surface encloses no volume"},
};

TEST(HostileInput, EachWrongSurfaceIsRefusedWithFileAndReason) {
  const TempFolder folder;
  const std::string text = tiny_case() + "[[wall]]\nname = 'stl'\nshapes = [{shape='stl', file='x.stl'}]\n";
  for (const WrongSurface& wrong : wrong_surfaces) {
    std::ofstream(folder / "x.stl", std::ios::binary | std::ios::trunc) << wrong.bytes;
    try {
      build_setup(parse_case(text, folder / "case.toml"));
      FAIL() << "accepted: " << wrong.fragment;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("x.stl"));
      EXPECT_THAT(error.what(), HasSubstr(wrong.fragment));
    }
  }
}

struct WrongOverride {
  std::string given, fragment;
};

const std::vector<WrongOverride> wrong_overrides{
    {"", "--set : allowed: --set dotted.key=value"},
    {"=1", "--set =1: allowed: --set dotted.key=value"},
    {"spacing", "--set spacing: allowed: --set dotted.key=value"},
    {"resolution..spacing=1", "empty part in the key"},
    {".spacing=1", "empty part in the key"},
    {"resolution.spacing.x=1", "cannot be set inside the value 0.002"},
    {"resolution=1", "key 'resolution': value 1 has the wrong type: allowed: a table"},
    {"resolution.spacing=", "key 'resolution.spacing': value \"\" has the wrong type"},
    {"resolution.spacing=1mm", "key 'resolution.spacing': value \"1mm\" has the wrong type"},
    {"resolution.spacing=-1", "key 'resolution.spacing': value -1 is out of range"},
    {"resolution.spacing=1e999", "key 'resolution.spacing'"},
    {"region.7.velocity=[0,0,0]", "'7' is not an entry of this list: allowed: 0 to 0"},
    {"region.-1.velocity=[0,0,0]", "'-1' is not an entry of this list"},
    {"region.99999999999999999999.velocity=[0,0,0]", "is not an entry of this list"},
    {"case.name=../../escape", "key 'case.name': value \"../../escape\" is not a name"},
    {"case.name=/escape", "key 'case.name': value \"/escape\" is not a name"},
    {"measure.0.name=../escape", "key 'measure.0.name': value \"../escape\" is not a name"},
    {"output.folder=/escape", "key 'output.folder': unknown"},
    {"output.file=../../x", "key 'output.file': unknown"},
    {"numerics.max_iterations=99999999999999999999", "numerics.max_iterations"},
    {"fluid.oil.density=" + std::string(300, '['), "brackets nested deeper than 200"},
};

TEST(HostileInput, EachWrongOverrideIsRefusedByItsName) {
  std::set<std::string> messages;
  for (const WrongOverride& wrong : wrong_overrides) {
    try {
      parse_case(tiny_case(), "tiny.toml", {wrong.given});
      FAIL() << "accepted: " << wrong.given;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--set " + wrong.given.substr(0, 80)));
      EXPECT_THAT(error.what(), HasSubstr(wrong.fragment));
      messages.insert(error.what());
    }
  }
  EXPECT_EQ(messages.size(), wrong_overrides.size());
}

std::string error_of_build(const std::vector<std::string>& overrides) {
  try {
    build_setup(parse_case(tiny_case(), "tiny.toml", overrides));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Before memory is asked for: each of these returns at once.
TEST(HostileInput, ImpossibleSizesAreToldWithWhatIsNeededAndWhatThereIs) {
  const std::string memory = "of memory, [0-9.e+]+ GB are available: allowed: a larger spacing";
  for (const char* spacing : {"2e-6", "3e-6", "4e-6"})
    EXPECT_THAT(error_of_build({std::string("resolution.spacing=") + spacing}),
                testing::ContainsRegex("key 'resolution.spacing'.*needs [0-9.e+]+ GB " + memory));
  EXPECT_THAT(error_of_build({"domain.max=[1e3,1e3,1e3]"}),
              testing::ContainsRegex("needs [0-9.e+]+ GB " + memory));
  EXPECT_THAT(error_of_build({"resolution.spacing=1e-30"}),
              HasSubstr("beyond what single precision holds the powers of"));
  EXPECT_THAT(error_of_build({"domain.min=[-1e30,-1e30,-1e30]"}), HasSubstr("more than 1e9 spacings"));
}

TEST(HostileInput, ACaseCannotWriteOutsideItsFolder) {
  const TempFolder folder;
  std::ofstream(folder / "tiny.toml") << tiny_case();
  const auto before = std::filesystem::current_path();
  std::filesystem::create_directories(folder / "at/work");
  std::filesystem::current_path(folder / "at/work");
  for (const char* name : {"../../escape", "..", "/escape", "a/b"}) {
    const std::string set = std::string("case.name=") + name, file = folder / "tiny.toml";
    const std::array<const char*, 5> argv{"slagflow", "run", file.c_str(), "--set", set.c_str()};
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_program(argv.size(), argv.data()), 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("is not a name"));
  }
  std::filesystem::current_path(before);
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    entries += entry.exists();
  EXPECT_EQ(entries, 3U) << "the case, and the two folders of this test";
}

}  // namespace
}  // namespace slagflow
