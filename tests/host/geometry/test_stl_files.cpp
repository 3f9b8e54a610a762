// Files called .stl that hold something else, or hold it in an odd way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "backend/error.hpp"
#include "host/geometry/stl.hpp"
#include "host/geometry_cases.hpp"

namespace slagflow {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string error_of(const std::string& bytes) {
  const std::string file = write_temp_file("odd.stl", bytes);
  try {
    closed_surface(read_stl(file), file);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

const std::vector<Triangle> a_box = box_triangles({0, 0, 0}, {1, 2, 3});

std::string with(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

TEST(StlFiles, OtherFormatsAreNamed) {
  struct Other {
    std::string bytes, name;
  };
  const std::vector<Other> others{{"# Blender 3.4\n# www\no Cube\nv 0 0 0\n", "Wavefront OBJ"},
                                  {"\n\nvn 0 0 1\nv 0 0 0\n", "Wavefront OBJ"},
                                  {"g body\r\nv 0 0 0\r\n", "Wavefront OBJ"},
                                  {"usemtl steel\nv 0 0 0\n", "Wavefront OBJ"},
                                  {"ply\nformat ascii 1.0\n", "a PLY file"},
                                  {"OFF\n8 6 12\n", "an OFF file"},
                                  {"ISO-10303-21;\nHEADER;\n", "a STEP file"},
                                  {std::string("PK\3\4\0\0", 6), "a ZIP archive"},
                                  {"\x1f\x8b\x08 packed", "gzip"},
                                  {std::string("\xff\xfes\0o\0l\0i\0d\0", 12), "UTF-16"},
                                  {"<?xml version=\"1.0\"?>\n<amf>", "an XML file"},
                                  {"{\"asset\": {}}", "a JSON file"},
                                  {"  0\nSECTION\n  2\nHEADER\n", "a DXF file"},
                                  {std::string(72, ' ') + "S      1\n", "an IGES file"},
                                  {"version https://git-lfs.github.com/spec/v1\n", "Git LFS"},
                                  {"#VRML V2.0 utf8\n", "a VRML file"}};
  for (const Other& other : others)
    EXPECT_THAT(error_of(other.bytes), AllOf(HasSubstr("odd.stl: looks like "), HasSubstr(other.name)));
}

TEST(StlFiles, ReadInEveryWayThatProgramsWriteThem) {
  const std::string ascii = ascii_stl(a_box), binary = binary_stl(a_box);
  std::string upper = ascii;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string called_solid = binary;
  called_solid.replace(0, 11, "solid a box");
  for (const std::string& bytes :
       {ascii, binary, upper, called_solid, binary + "abc", binary + std::string(49, '\0'),
        "\xef\xbb\xbf" + ascii, with(ascii, "\n", "\r\n"), with(ascii, "\n", "\r"), with(ascii, "  ", "\t"),
        "\n \n" + ascii})
    EXPECT_EQ(error_of(bytes), "accepted") << bytes.substr(0, 100);
}

TEST(StlFiles, WhatIsWrongIsToldWithItsPlace) {
  const std::string ascii = ascii_stl(a_box), binary = binary_stl(a_box);
  EXPECT_THAT(error_of(binary.substr(0, 400)),
              HasSubstr("400 bytes, but its header announces 12 triangles = 684 bytes: it is cut short"));
  EXPECT_THAT(error_of(binary + std::string(200, 'x')),
              HasSubstr("884 bytes, but its header announces 12 triangles = 684 bytes: it has too many"));
  std::string called_solid = binary.substr(0, 400);
  called_solid.replace(0, 11, "solid a box");
  EXPECT_THAT(error_of(called_solid), HasSubstr("400 bytes, but its header announces 12 triangles"));
  EXPECT_THAT(error_of(ascii.substr(0, 300)), HasSubstr("the end of the file: it is cut short"));
  EXPECT_THAT(error_of(with(ascii, "1.000000 0", "1,000000 0")),
              HasSubstr("a number, with a decimal point, expected, found '1,000000'"));
  std::vector<Triangle> wrong = a_box;
  wrong[7][1].y = NAN;
  EXPECT_THAT(error_of(binary_stl(wrong)),
              HasSubstr("odd.stl, byte 434: triangle 7 has a coordinate that is not a number"));
  EXPECT_THAT(error_of(ascii_stl(wrong)),
              HasSubstr("odd.stl:57: triangle 7 has a coordinate that is not a number"));
  wrong[7][1].y = 1e25;
  EXPECT_THAT(error_of(binary_stl(wrong)),
              AllOf(HasSubstr("no triangle has an area"), HasSubstr("the farthest corner is (1, 1e+25, 3)")));
}

TEST(StlFiles, EscapesInThePathAreTold) {
  try {
    read_stl("..\rinne.stl");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("cannot be read; a backslash in \"...\" begins an escape"));
  }
}

}  // namespace
}  // namespace slagflow
