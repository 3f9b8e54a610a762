#include "host/program/init.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <istream>
#include <ostream>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/case/case_table.hpp"
#include "host/case/toml_reader.hpp"
#include "host/geometry/setup_builder.hpp"

namespace slagflow {
namespace {

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const CaseTemplate& one : case_templates()) all.emplace_back(one.name);
  return all;
}

std::string with_comment(const std::string& line, const char* comment) {
  return line + std::string(line.size() < 28 ? 28 - line.size() : 1, ' ') + "# " + comment + "\n";
}

std::string fluid_text(const StartValues& v) {
  const std::string density = with_comment("density = " + show(v.density), "[kg/m^3]");
  if (v.yield_stress > 0)
    return density + with_comment("rheology = \"bingham\"", "flows above its yield stress alone") +
           with_comment("plastic_viscosity = " + show(v.viscosity), "[Pa s] once it flows") +
           with_comment("yield_stress = " + show(v.yield_stress), "[Pa]");
  return density + with_comment("rheology = \"newtonian\"", "\"bingham\" where it has a yield stress") +
         with_comment("dynamic_viscosity = " + show(v.viscosity), "[Pa s]");
}

void replace_all(std::string& text, const std::string& mark, const std::string& by) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

// The answer to a question; empty: the default.
std::string answer(std::istream& in, std::ostream& out, const std::string& question) {
  out << question << std::flush;
  std::string line;
  if (!std::getline(in, line)) throw InputError("init: no answer: allowed: --template NAME asks nothing");
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.pop_back();
  return line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
}

std::string ask_template(std::istream& in, std::ostream& out) {
  for (const CaseTemplate& one : case_templates())
    out << "  " << one.name << std::string(12 - std::strlen(one.name), ' ') << one.what << "\n";
  while (true) {
    std::string said = answer(in, out, "which of them [" + names().front() + "]: ");
    if (said.empty()) return names().front();
    const std::vector<std::string> known = names();
    if (std::find(known.begin(), known.end(), said) != known.end()) return said;
    out << "'" << said << "': " << suggestion(said, known) << "allowed: " << join(known) << "\n";
  }
}

double ask_number(std::istream& in, std::ostream& out, const std::string& what, const Range& range,
                  double fallback) {
  while (true) {
    const std::string said = answer(in, out, what + " [" + show(fallback) + "]: ");
    if (said.empty()) return fallback;
    char* end = nullptr;
    const double value = std::strtod(said.c_str(), &end);
    if (*end == '\0' && range.holds(value)) return value;
    out << "'" << said << "': allowed: " << range.text() << "\n";
  }
}

StartValues ask_values(std::istream& in, std::ostream& out, StartValues v) {
  v.density = ask_number(in, out, "density of the fluid [kg/m^3]", above(0, ""), v.density);
  v.viscosity = ask_number(in, out, "viscosity, once it flows [Pa s]", above(0, ""), v.viscosity);
  v.yield_stress = ask_number(in, out, "yield stress, 0 for none [Pa]", at_least(0, ""), v.yield_stress);
  v.spacing = ask_number(in, out, "spacing of the particles [m]", above(0, ""), v.spacing);
  return v;
}

void write_new(const std::string& path, const std::string& text) {
  std::FILE* const file = std::fopen(path.c_str(), "wx");
  if (file == nullptr && errno == EEXIST)
    throw InputError(path + ": is there already: allowed: -o with a name that is not, or remove it");
  if (file == nullptr)
    throw InputError(path + ": cannot be written: " + std::strerror(errno) +
                     ": allowed: -o with another name");
  const bool written = std::fputs(text.c_str(), file) >= 0;
  if (std::fclose(file) == 0 && written) return;
  const std::string reason = std::strerror(errno);
  std::remove(path.c_str());
  throw Error("cannot write " + path + ": " + reason);
}

// A name of a case from that of its file.
std::string name_of(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::strchr("_-.", c) == nullptr) c = '_';
  return name.empty() || name[0] == '.' || name[0] == '-' ? "case" + name : name;
}

}  // namespace

const CaseTemplate& case_template(const std::string& name) {
  for (const CaseTemplate& one : case_templates())
    if (name == one.name) return one;
  throw InputError("template '" + shortened(name) + "': unknown: " + suggestion(name, names()) +
                   "allowed: " + join(names()));
}

std::string case_text(const CaseTemplate& chosen, const StartValues& values, const std::string& name) {
  std::string text = chosen.text;
  replace_all(text, "@NAME@", name);
  replace_all(text, "@SPACING@", show(values.spacing));
  replace_all(text, "@FLUID@\n", fluid_text(values));
  return text;
}

std::string init_case(const InitOptions& options, std::istream& in, std::ostream& out) {
  const bool asks = options.terminal && options.given.empty();
  std::string name = options.given.empty() ? options.asked : options.given;
  if (name.empty() && !asks)
    throw InputError("init: no template, and no terminal to ask at: allowed: " + join(names()));
  if (!name.empty()) case_template(name);
  if (name.empty()) name = ask_template(in, out);
  const CaseTemplate& chosen = case_template(name);
  StartValues values = chosen.values;
  values.density = options.density.value_or(values.density);
  values.viscosity = options.viscosity.value_or(values.viscosity);
  values.yield_stress = options.yield_stress.value_or(values.yield_stress);
  values.spacing = options.spacing.value_or(values.spacing);
  if (asks) values = ask_values(in, out, values);
  const std::string path = options.output.empty() ? name + ".toml" : options.output;
  const std::string text = case_text(chosen, values, name_of(path));
  const Case c = parse_case(text, path);                       // refuses values that are out of range
  if (values.spacing > chosen.values.spacing) build_setup(c);  // and spacings that leave no particle
  write_new(path, text);
  return "wrote " + path + ": " + chosen.what + "\nnext: slagflow check " + path + ", then slagflow run " +
         path + "\n";
}

}  // namespace slagflow
