// What the kinds of `slagflow rheometry` share: the form of their answers, and where these go.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "host/rheometry/rheometry_data.hpp"

namespace slagflow {

struct Answer {
  std::string text;    // for people
  std::string table;   // the [fluid.NAME] table
  std::string curves;  // CSV, for the picture
  std::vector<std::string> warnings;
};

// In the first line of what is written.
inline constexpr const char *table_mark = " by slagflow ", *curves_mark = ",measured_";

template <class... Arguments>
std::string print(const char* pattern, Arguments... arguments) {
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(), pattern, arguments...);
  return text.data();
}

// Six significant digits are more than any viscometer has.
double rounded(double value);

struct NamedEstimate {
  const char* key;
  const char* unit;
  Estimate estimate;
};
std::string interval(const NamedEstimate& e);

// "# FILE by slagflow VERSION (COMMIT): WHAT."
std::string first_line(const std::string& source, const std::string& what);

// As the facts have it, else from the name of the file.
std::string fluid_name(const SampleFacts& facts, const std::string& file);

// The line of the density, or that it must be added.
std::string density_line(const SampleFacts& facts);

// Before anything is computed: whether an answer for `file` may be written to X.toml and X.csv. Empty output:
// it is not. Throws InputError.
void require_output(const std::string& output, const std::string& file);

// Text and table to stdout, warnings to stderr, table and curves to the files.
void deliver(const Answer& answer, const std::string& output);

}  // namespace slagflow
