// slagflow init: a commented case to begin with.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace slagflow {

// The fluid and the fineness of a case: what a beginner has to know.
struct StartValues {
  double density = 0, viscosity = 0, yield_stress = 0;  // [kg/m^3], [Pa s], [Pa]; 0: Newtonian
  double spacing = 0;                                   // [m]
};

// A case with marks in place of name, spacing and fluid.
struct CaseTemplate {
  const char* name;
  const char* what;
  StartValues values;
  const char* text;
};
const std::vector<CaseTemplate>& case_templates();
// Throws InputError with what is allowed.
const CaseTemplate& case_template(const std::string& name);

// The case, by the name it gets.
std::string case_text(const CaseTemplate& chosen, const StartValues& values, const std::string& name);

struct InitOptions {
  std::string asked;   // name of the template; empty: a question
  std::string given;   // the same, and nothing is asked
  std::string output;  // file; empty: NAME.toml
  std::optional<double> density, viscosity, yield_stress, spacing;
  bool terminal = false;  // somebody may be asked
};

// Writes the file and gives what to tell. Questions go to `out`. Throws InputError where the values make no
// case, the file is there, or nobody answers.
std::string init_case(const InitOptions& options, std::istream& in, std::ostream& out);

}  // namespace slagflow
