// TOML text to a tree of values that know where they stand; the rest of the host layer sees no parser.
#pragma once

#include <map>
#include <string>
#include <toml.hpp>
#include <vector>

#include "host/case/toml_text.hpp"

namespace slagflow {

using Toml = toml::basic_value<toml::discard_comments, std::map, std::vector>;

constexpr long override_order = 1000000000;  // of a place that is no line

// Where a value was given, for messages.
struct Place {
  std::string text;  // "FILE:LINE" or "--set key=value"
  long order = 0;    // sorts places of one case: by line, overrides last
};

// A text and the tree that it says.
class TomlFile {
 public:
  // `name` stands for the text in messages. Throws InputError "NAME:LINE: ..." on a syntax error.
  TomlFile(const std::string& given, const std::string& name);

  Toml& root() { return root_; }
  // Of a value of the tree, or of an override in it.
  Place place_of(const Toml& value) const;

 private:
  long number_of(std::size_t parsed_line) const;

  std::string name_;
  std::vector<TextLine> lines_;  // as they were parsed
  Toml root_;
};

// Applies "dotted.key=value" to the tree. The value is TOML or else a bare string; tables on the way are
// made when missing, entries of lists must exist. Throws InputError.
void apply_override(Toml& root, const std::string& assignment);

// Up to 80 bytes of a text that may be long, for messages; and in quotes.
std::string shortened(const std::string& text, std::size_t most = 80);
std::string in_quotes(const std::string& text);

// A value as a short text for messages, on one line.
std::string show(const Toml& value);

// The shortest text that reads back as the same number, always recognisable as a TOML float.
std::string show(double number);

}  // namespace slagflow
