#include "host/case/case.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "backend/error.hpp"
#include "host/case/case_keys.hpp"
#include "host/case/case_reader.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/keys_thermal.hpp"

namespace slagflow {
namespace {

constexpr std::streamoff largest_file = 16 << 20;  // a case file is a few kB; more is a mistake

std::string read_text(const std::string& path) {
  std::error_code failure;
  const bool regular = std::filesystem::is_regular_file(path, failure);  // a pipe would wait for its writer
  std::ifstream stream;
  if (regular) stream.open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.is_open() ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) {
    const bool there = std::filesystem::exists(path, failure);
    const bool folder = std::filesystem::is_directory(path, failure);
    throw InputError(path + ": " +
                     (folder  ? "is a folder"
                      : there ? "cannot be read"
                              : "is not there") +
                     ": allowed: a case file (TOML) that can be read");
  }
  if (size > largest_file)
    throw InputError(path + ": " + std::to_string(size) + " bytes: allowed: a case file up to " +
                     std::to_string(largest_file) + " bytes");
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  if (!stream.read(text.data(), size))
    throw InputError(path + ": cannot be read: allowed: a case file (TOML)");
  return text;
}

void apply_overrides(Toml& root, const std::vector<std::string>& overrides, CaseProblems& problems) {
  for (const std::string& assignment : overrides) {
    try {
      apply_override(root, assignment);
    } catch (const InputError& e) {
      problems.add_message(e.what());
    }
  }
}

}  // namespace

Case load_case(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_case(read_text(path), path, overrides);
}

Case parse_case(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  TomlFile source(text, file);
  CaseProblems problems(file, source);
  apply_overrides(source.root(), overrides, problems);
  Case c;
  c.file = file;
  CaseReader reader(source.root(), Place{file + ":1", 0}, problems);
  describe(reader, c);
  reader.finish();
  resolve_thermal(c);
  check_across_tables(c, problems);
  check_thermal(c, problems);
  problems.raise();
  for (const auto& [key, place] : problems.places()) c.places[key] = place.text;
  return c;
}

Direction down(const Case& c) {
  const Vec3d g = c.gravity;
  const int xy = std::abs(g.y) > std::abs(g.x) ? 1 : 0;
  const int axis = std::abs(g.z) >= std::abs(g[xy]) ? 2 : xy;
  return {axis, g[axis] > 0 ? 1 : -1};
}

bool has_surface_tension(const Case& c) {
  for (const FluidSpec& fluid : c.fluids)
    if (fluid.surface_tension > 0) return true;
  return false;
}

std::string Case::place_of(const std::string& key) const {
  for (std::string part = key; !part.empty();) {
    const auto found = places.find(part);
    if (found != places.end()) return found->second;
    const auto dot = part.rfind('.');
    part = dot == std::string::npos ? "" : part.substr(0, dot);
  }
  return file;
}

}  // namespace slagflow
