// What is looked at in the text of a case file before it is parsed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slagflow {

// Throws InputError "NAME:LINE: ..." where the text is not UTF-8, or holds a zero.
void check_encoding(const std::string& text, const std::string& name);

// Throws InputError where brackets or dotted keys are nested deeper than the parser's recursion bears.
void check_nesting(const std::string& text, const std::string& name);

struct TextLine {
  std::size_t begin = 0;  // [bytes] in the text
  long number = 1;        // of the line of the file
};
struct BrokenText {
  std::string text;
  std::vector<TextLine> lines;
};
// With line feeds where a text ends its lines with carriage returns alone.
std::string with_line_feeds(std::string text);

// The same TOML with long lines broken between the entries of lists: the parser goes over the whole line for
// each value.
BrokenText break_long_lines(const std::string& text);

}  // namespace slagflow
