// TOML text to a tree of values that know where they stand; the rest of the host layer sees no parser.
#pragma once

#include <map>
#include <string>
#include <toml.hpp>
#include <vector>

namespace slagflow {

using Toml = toml::basic_value<toml::discard_comments, std::map, std::vector>;

// Where a value was given, for messages.
struct Place {
  std::string text;  // "FILE:LINE" or "--set key=value"
  long order = 0;    // sorts places of one case: by line, overrides last
};

// Parses text; `name` stands for it in messages. Throws InputError "NAME:LINE: ..." on a syntax error.
Toml parse_toml(const std::string& text, const std::string& name);

// Applies "dotted.key=value" to the tree. The value is TOML or else a bare string; tables on the way are
// made when missing, entries of lists must exist. Throws InputError.
void apply_override(Toml& root, const std::string& assignment);

Place place_of(const Toml& value);

// A value as a short text for messages, on one line.
std::string show(const Toml& value);

// The shortest text that reads back as the same number, always recognisable as a TOML float.
std::string show(double number);

}  // namespace slagflow
