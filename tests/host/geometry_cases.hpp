// Small cases and STL files for the tests of the geometry.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/stl.hpp"

namespace slagflow {

// A case with spacing 1 (lengths read as spacings), water and a domain of 10 x 10 x 10.
inline Case unit_case() {
  return parse_case(R"(
[case]
name = "unit"
[resolution]
spacing = 1
[gravity]
acceleration = [0, 0, -10]
[fluid.water]
density = 1000
rheology = "newtonian"
dynamic_viscosity = 1e-3
[[region]]
shapes = [{shape="box", min=[4,4,4], max=[6,6,6]}]
[domain]
min = [0, 0, 0]
max = [10, 10, 10]
[output]
end_time = 1
)",
                    "unit.toml");
}

inline ShapeSpec box(Vec3d min, Vec3d max) { return {BoxSpec{min, max}, false}; }
inline ShapeSpec outside(ShapeSpec shape) {
  shape.outside = true;
  return shape;
}

inline WallSpec wall(const std::string& name, std::vector<ShapeSpec> shapes) {
  WallSpec w;
  w.name = name;
  w.shapes = std::move(shapes);
  return w;
}

// The twelve triangles of a box, corners counter-clockwise seen from outside.
inline std::vector<Triangle> box_triangles(Vec3d a, Vec3d b) {
  const auto corner = [&](int i) {
    return Vec3d{(i & 1) ? b.x : a.x, (i & 2) ? b.y : a.y, (i & 4) ? b.z : a.z};
  };
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return triangles;
}

inline std::string binary_stl(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) put(0.0f);
    for (const Vec3d& v : t)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(v[k]));
    put(std::uint16_t{0});
  }
  return bytes;
}

inline std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid a box\n";
  for (const Triangle& t : triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const Vec3d& v : t)
      text += "      vertex " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) +
              "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a box\n";
}

inline std::string write_temp_file(const std::string& name, const std::string& bytes) {
  const std::string folder = testing::TempDir() + "slagflow_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);  // tests run beside each other
  std::string path = folder + "/" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline ShapeSpec stl_shape(const std::string& path) { return {StlSpec{path, 1, {0, 0, 0}}, false}; }

}  // namespace slagflow
