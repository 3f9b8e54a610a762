// Writes points with data as VTKHDF 2.x PolyData: one file with all time steps, which ParaView 5.12+ and
// VTK 9.3+ open as it is (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, 'VTKHDF').
//
// The file is opened, appended to and closed for each step; disk space is taken before anything is changed,
// and the number of steps is written last. The rows
// of a step start at a multiple of the chunk length (see Steps/PointOffsets and Steps/PointDataOffsets), so
// that no data of an earlier step is ever written again: after a crash the file reads up to the last step.
// There is one vertex for each point.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fluid/math.hpp"

namespace slagflow {

namespace hdf5 {
class File;
}

// The number of time steps that an open file holds, the unfinished one of a crash not counted. Throws Error.
std::int64_t vtkhdf_steps(const hdf5::File& file);

enum class ArrayType { float32, uint8, int64 };

struct ArrayInfo {
  std::string name;
  std::string units;  // "1" for a plain number
  std::string meaning;
  ArrayType type = ArrayType::float32;
  int components = 1;  // 1 or 3
};

// Borrowed values of one array, one row for each point.
struct ArrayView {
  ArrayType type = ArrayType::float32;
  int components = 1;
  const void* data = nullptr;
  std::size_t size = 0;

  ArrayView(const std::vector<float>& v) : data(v.data()), size(v.size()) {}
  ArrayView(const std::vector<Vector3<float>>& v) : components(3), data(v.data()), size(v.size()) {}
  ArrayView(const std::vector<std::uint8_t>& v) : type(ArrayType::uint8), data(v.data()), size(v.size()) {}
  ArrayView(const std::vector<std::int64_t>& v) : type(ArrayType::int64), data(v.data()), size(v.size()) {}
};

struct PointStep {
  double time = 0;                     // [s]
  const std::vector<Vec3d>& position;  // [m], stored in fp64: a plant may stand at map coordinates
  std::vector<ArrayView> arrays;       // in the order of VtkhdfWriter::arrays()
};

class VtkhdfWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  // Names a file; nothing is written yet.
  VtkhdfWriter(std::string path, std::vector<ArrayInfo> arrays);

  const std::string& path() const { return path_; }
  const std::vector<ArrayInfo>& arrays() const { return arrays_; }

  // Creates the file without time steps, or replaces it. `points_expected`, the number of points of a
  // usual step, sets the chunk length. The attributes are put at the group VTKHDF.
  // Throws Error that names the file.
  void create(const Attributes& attributes, std::size_t points_expected) const;

  // Changes attributes of an existing file, as far as they differ. Throws Error that names the file.
  void describe(const Attributes& attributes) const;

  // Cuts an existing file off behind its first `steps` time steps. Throws Error that names the file: it
  // cannot be changed, or holds fewer.
  void truncate(std::int64_t steps) const;

  // Appends a time step with any number of points to the file, which must have been created.
  // Throws Error that names the file: it cannot be written, or the disk is full.
  void append(const PointStep& step) const;

  // As append, with the points of the first step, which the file then holds once. The first step itself
  // is written by append.
  void append_at_same_points(const PointStep& step) const;

 private:
  enum class Points { own, of_first_step };
  // Where a step's rows begin.
  struct FirstRows {
    std::int64_t step = 0, point = 0, cell = 0;
    std::vector<std::int64_t> data;
  };
  void append(const PointStep& step, Points points) const;
  FirstRows write_bulk(const PointStep& step, Points points) const;
  void write_indices(const PointStep& step, const FirstRows& first) const;
  std::size_t bytes_of(const PointStep& step) const;

  std::string path_;
  std::vector<ArrayInfo> arrays_;
};

}  // namespace slagflow
