#include "host/geometry/stl.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "backend/error.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/stl_formats.hpp"
#include "host/geometry/stl_weld.hpp"

namespace slagflow {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;
constexpr std::streamoff largest_file = std::streamoff{1} << 30;

// A path of Windows in double quotes loses its backslashes to escapes such as \t.
std::string advice_on_escapes(const std::string& file) {
  const bool escaped = std::any_of(file.begin(), file.end(), [](unsigned char c) { return c < ' '; });
  return escaped ? "; a backslash in \"...\" begins an escape: write / in paths, or single quotes '...'" : "";
}

std::string read_bytes(const std::string& file) {
  std::error_code failure;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0 || !std::filesystem::is_regular_file(file, failure))
    throw InputError(file + ": cannot be read" + advice_on_escapes(file));
  if (size > largest_file)
    throw InputError(file + ": " + std::to_string(size) + " bytes: allowed: up to " +
                     std::to_string(largest_file));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  if (!stream.read(bytes.data(), size)) throw InputError(file + ": cannot be read");
  return bytes;
}

void check_finite(const Triangle& triangle, std::size_t index, const std::string& place) {
  for (const Vec3d& v : triangle)
    if (!(std::abs(v.x) + std::abs(v.y) + std::abs(v.z) < 1e30))  // catches not-a-number as well
      throw InputError(place + ": triangle " + std::to_string(index) +
                       " has a coordinate that is not a number or beyond 1e30: " + corner_text(v));
}

std::size_t declared_count(const std::string& bytes) {
  if (bytes.size() < header_bytes) return std::numeric_limits<std::size_t>::max();
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
  return count;
}

std::vector<Triangle> read_binary(const std::string& bytes, const std::string& file) {
  std::vector<Triangle> triangles(declared_count(bytes));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    float numbers[12];  // normal and three corners
    std::memcpy(numbers, bytes.data() + header_bytes + t * triangle_bytes, sizeof numbers);
    for (std::size_t c = 0; c < 3; ++c)
      triangles[t][c] = {numbers[3 * c + 3], numbers[3 * c + 4], numbers[3 * c + 5]};
    check_finite(triangles[t], t, file + ", byte " + std::to_string(header_bytes + t * triangle_bytes));
  }
  return triangles;
}

// Words of an ASCII file with the line they stand on.
class Words {
 public:
  Words(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  // The next word in lower case; empty at the end of the file.
  std::string next() {
    for (; at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])); ++at_)
      if (text_[at_] == '\n' || (text_[at_] == '\r' && text_.compare(at_, 2, "\r\n") != 0)) ++line_;
    std::string word;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_++])));
    return word;
  }
  void skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
  std::string place() const { return file_ + ":" + std::to_string(line_); }
  void expect(const char* wanted) {
    const std::string word = next();
    if (word != wanted) fail(std::string("'") + wanted + "'", word);
  }
  double number() {
    const std::string word = next();
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    const bool comma = std::count(word.begin(), word.end(), ',') == 1;
    if (word.empty() || *end) fail(comma ? "a number, with a decimal point," : "a number", word);
    return value;
  }
  [[noreturn]] void fail(const std::string& wanted, const std::string& found) const {
    throw InputError(
        place() + ": " + wanted + " expected, found " +
        (found.empty() ? "the end of the file: it is cut short" : "'" + shortened(found, 40) + "'"));
  }

 private:
  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  long line_ = 1;
};

Triangle read_facet(Words& words) {
  words.expect("normal");
  for (int k = 0; k < 3; ++k) words.next();  // often wrong in the wild; the order of the corners is used
  words.expect("outer");
  words.expect("loop");
  Triangle triangle;
  for (Vec3d& corner : triangle) {
    words.expect("vertex");
    for (int k = 0; k < 3; ++k) corner[k] = words.number();
  }
  words.expect("endloop");
  words.expect("endfacet");
  return triangle;
}

std::vector<Triangle> read_ascii(const std::string& text, const std::string& file) {
  std::vector<Triangle> triangles;
  Words words(text, file);
  words.expect("solid");
  words.skip_line();
  bool open = true;
  for (std::string word = words.next(); open || !word.empty(); word = words.next()) {
    if (open && word == "facet") {
      triangles.push_back(read_facet(words));
      check_finite(triangles.back(), triangles.size() - 1, words.place());
    } else if (open ? word == "endsolid" : word == "solid") {
      open = !open;
      words.skip_line();
    } else {
      words.fail(open ? "'facet' or 'endsolid'" : "'solid'", word);
    }
  }
  return triangles;
}

// Every edge must be run through as often one way as the other. Places are those of the file.
void check_closed(const WeldedSurface& surface, const std::string& name) {
  const auto& [triangles, corners, tolerance] = surface;
  struct Uses {
    long forward = 0, backward = 0;
    Vec3d from, to;
  };
  std::map<std::pair<std::size_t, std::size_t>, Uses> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = corners[t][c], b = corners[t][(c + 1) % 3];
      Uses& uses = edges[std::minmax(a, b)];
      ++(a < b ? uses.forward : uses.backward);
      uses.from = triangles[t][c], uses.to = triangles[t][(c + 1) % 3];
    }
  std::size_t open = 0, against = 0;
  const Uses *first_open = nullptr, *first_against = nullptr;
  for (const auto& [edge, uses] : edges) {
    if ((uses.forward + uses.backward) % 2 != 0)
      ++open, first_open = first_open == nullptr ? &uses : first_open;
    else if (uses.forward != uses.backward)
      ++against, first_against = first_against == nullptr ? &uses : first_against;
  }
  const auto place = [](const Uses& uses) { return corner_text(uses.from) + " to " + corner_text(uses.to); };
  if (open > 0)
    throw InputError(name + ": the surface is not closed: " + std::to_string(open) +
                     " open edges, one from " + place(*first_open) +
                     " in the file's units (corners closer than " + length_text(tolerance) +
                     " count as one): allowed: 0, every edge shared by two triangles; a shape's 'thickness' "
                     "makes a plate of an open surface");
  if (against > 0)
    throw InputError(name + ": the triangles do not agree which side is outside, at " +
                     std::to_string(against) + " edges, one from " + place(*first_against) +
                     ": allowed: corners in the same sense all over the surface");
}

// Binary: as many triangles as the header announces, and less than one more: some writers round the size up.
bool is_binary(const std::string& bytes, std::size_t count) {
  if (bytes.size() < header_bytes) return false;
  const std::size_t rest = bytes.size() - header_bytes;
  return rest / triangle_bytes == count && (count > 0 || rest == 0);
}

[[noreturn]] void refuse(const std::string& file, const std::string& bytes, std::size_t count) {
  const std::string format = other_format(bytes);
  if (!format.empty())
    throw InputError(file + ": looks like " + format +
                     ": allowed: an STL file, ASCII or binary, as CAD programs export");
  if (bytes.size() < header_bytes)
    throw InputError(file + ": " + std::to_string(bytes.size()) + " bytes, too short for an STL file");
  const std::size_t announced = header_bytes + count * triangle_bytes;
  throw InputError(
      file + ": " + std::to_string(bytes.size()) + " bytes, but its header announces " +
      std::to_string(count) + " triangles = " + std::to_string(announced) + " bytes: " +
      (bytes.size() < announced ? "it is cut short, or no STL file" : "it has too many, or is no STL file"));
}

bool begins_with_solid(const std::string& bytes, std::size_t first) {
  const std::string wanted = "solid";
  if (first == std::string::npos || bytes.size() < first + wanted.size()) return false;
  return std::equal(wanted.begin(), wanted.end(), bytes.begin() + static_cast<std::ptrdiff_t>(first),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

}  // namespace

std::vector<Triangle> read_stl(const std::string& file) {
  std::string bytes = read_bytes(file);
  const std::size_t count = declared_count(bytes);
  const bool binary = is_binary(bytes, count);
  const std::string mark = "\xef\xbb\xbf";  // of UTF-8, by some editors
  if (!binary && bytes.compare(0, mark.size(), mark) == 0) bytes.erase(0, mark.size());
  const auto first = bytes.find_first_not_of(" \t\r\n");
  const bool ascii = begins_with_solid(bytes, first) && bytes.find('\0') == std::string::npos;
  if (!binary && !ascii) refuse(file, bytes, count);
  std::vector<Triangle> triangles = binary ? read_binary(bytes, file) : read_ascii(bytes, file);
  if (triangles.empty()) throw InputError(file + ": holds no triangle");
  return triangles;
}

std::vector<Triangle> closed_surface(const std::vector<Triangle>& triangles, const std::string& name) {
  WeldedSurface surface = weld(triangles, name);
  check_closed(surface, name);
  turn_bodies_outward(surface.triangles, surface.corners, name);
  return std::move(surface.triangles);
}

}  // namespace slagflow
