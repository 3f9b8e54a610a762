#include "host/geometry/stl_formats.hpp"

#include <array>

namespace slagflow {
namespace {

struct Format {
  const char *beginning, *name;
};

constexpr const char* obj = "a Wavefront OBJ file";

// Of the first line that is no comment.
constexpr std::array<Format, 17> text_formats{
    {{"v ", obj},
     {"vn ", obj},
     {"vt ", obj},
     {"o ", obj},
     {"g ", obj},
     {"s ", obj},
     {"f ", obj},
     {"mtllib", obj},
     {"usemtl", obj},
     {"ply", "a PLY file"},
     {"ISO-10303", "a STEP file"},
     {"<!DOCTYPE html", "a web page"},
     {"<html", "a web page"},
     {"<", "an XML file, as AMF and COLLADA are"},
     {"{", "a JSON file, as glTF is"},
     {"$MeshFormat", "a Gmsh file"},
     {"version https://git-lfs", "a pointer of Git LFS to a file"}}};

constexpr std::array<Format, 10> whole_formats{{{"PK", "a ZIP archive, as 3MF is"},
                                                {"\x1f\x8b", "a file packed by gzip"},
                                                {"7z", "a 7-Zip archive"},
                                                {"Rar!", "a RAR archive"},
                                                {"\xff\xfe", "UTF-16 text"},
                                                {"\xfe\xff", "UTF-16 text"},
                                                {"glTF", "a binary glTF file"},
                                                {"\x89HDF", "an HDF5 file"},
                                                {"#VRML", "a VRML file"},
                                                {"# vtk", "a VTK file"}}};

bool begins(const std::string& bytes, std::size_t at, const std::string& with) {
  return bytes.compare(at, with.size(), with) == 0;
}

// Behind blank lines and those that begin with #; the end of the text where there is nothing else.
std::size_t first_words(const std::string& text) {
  constexpr const char* blank = " \t\r\n";
  std::size_t at = text.find_first_not_of(blank);
  while (at != std::string::npos && text[at] == '#') {
    at = text.find_first_of("\r\n", at);
    if (at != std::string::npos) at = text.find_first_not_of(blank, at);
  }
  return at == std::string::npos ? text.size() : at;
}

// Column 73 of an IGES file says S, first come its notes.
bool is_iges(const std::string& text) {
  constexpr std::size_t column = 72;
  return text.size() > column && text[column] == 'S' && text.find_first_of("\r\n") > column;
}

}  // namespace

std::string other_format(const std::string& bytes) {
  for (const Format& format : whole_formats)
    if (begins(bytes, 0, format.beginning)) return format.name;
  const std::size_t first = first_words(bytes);
  for (const Format& format : text_formats)
    if (begins(bytes, first, format.beginning)) return format.name;
  const std::string line = bytes.substr(first, bytes.find_first_of("\r\n", first) - first);
  if (line == "OFF" || line == "COFF" || line == "NOFF") return "an OFF file";
  if (line == "0" && bytes.find("SECTION", first) < first + 20) return "a DXF file";
  if (is_iges(bytes)) return "an IGES file";
  return "";
}

}  // namespace slagflow
