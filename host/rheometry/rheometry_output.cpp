#include "host/rheometry/rheometry_output.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "backend/error.hpp"
#include "host/case/case_rules.hpp"
#include "host/case/toml_reader.hpp"
#include "host/output/provenance.hpp"
#include "host/run/run_folder.hpp"

namespace slagflow {
namespace {

// What an earlier answer left may be replaced, other files not. `mark` is in the first line of such a file.
void require_own(const std::string& path, const std::string& mark) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line.find(mark) != std::string::npos) return;
  throw InputError("output " + path + ": is there and not by slagflow rheometry: allowed: another name");
}

std::string curves_of(const std::string& output) {
  return std::filesystem::path(output).replace_extension(".csv").string();
}

}  // namespace

double rounded(double value) { return std::strtod(print("%.6g", value).c_str(), nullptr); }

std::string interval(const NamedEstimate& e) {
  const std::string unit = *e.unit ? std::string(" ") + e.unit : "";
  if (e.estimate.low == e.estimate.high)
    return print("%s %.5g%s (held)", e.key, e.estimate.value, unit.c_str());
  return print("%s %.5g%s (%.5g to %.5g)", e.key, e.estimate.value, unit.c_str(), e.estimate.low,
               e.estimate.high);
}

std::string first_line(const std::string& source, const std::string& what) {
  const Provenance here = build_provenance();
  return "# " + source + table_mark + here.version + " (" + here.commit + "): " + what + ".\n";
}

std::string fluid_name(const SampleFacts& facts, const std::string& file) {
  if (facts.name) return *facts.name;
  std::string name = std::filesystem::path(file).stem().string();
  for (char& c : name)
    if (!is_plain_name(std::string(1, c)) && c != '-') c = '_';
  if (!is_plain_name(name)) name = "fluid_" + name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

std::string density_line(const SampleFacts& facts) {
  return facts.density ? "density = " + show(rounded(*facts.density)) + "\n"
                       : "# density = ...  # [kg/m^3] must be added\n";
}

void require_output(const std::string& output, const std::string& file) {
  if (output.empty()) return;
  const std::filesystem::path path(output);
  if (path.extension() != ".toml")
    throw InputError("output " + output + ": allowed: a name that ends in .toml");
  const std::string curves = curves_of(output);
  std::error_code ignored;
  if (std::filesystem::equivalent(curves, file, ignored))
    throw InputError("output " + output + ": its curves would replace the measurements in " + curves +
                     ": allowed: another name");
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (!std::filesystem::is_directory(folder, ignored) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError("output " + output + ": " + folder +
                     " is no folder that can be written to: allowed: a name in one");
  require_own(output, table_mark);
  require_own(curves, curves_mark);
}

void deliver(const Answer& answer, const std::string& output) {
  for (const std::string& warning : answer.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::fputs((answer.text + "\n" + answer.table).c_str(), stdout);
  if (output.empty()) return;
  write_file(output, answer.table);
  write_file(curves_of(output), answer.curves);
}

}  // namespace slagflow
