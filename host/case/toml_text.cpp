#include "host/case/toml_text.hpp"

#include <algorithm>

#include "backend/error.hpp"

namespace slagflow {
namespace {

// The parser recurses for every bracket and every part of a dotted key; a hostile file must not exhaust
// the stack.
constexpr int deepest_nesting = 200, most_dots = 10000;
constexpr std::size_t long_line = 1000;  // [bytes]

// Bytes of the character of UTF-8 that begins here; 0 if there is none (Unicode standard, table 3-7).
std::size_t length_of_character(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0u;
  };
  const auto follows = [&](std::size_t k) { return byte(k) >= 0x80 && byte(k) <= 0xBF; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second > 0x9F;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first < 0xF0 || first > 0xF4) return 0;
  const bool overlong = first == 0xF0 && second < 0x90, beyond = first == 0xF4 && second > 0x8F;
  return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
}

// Behind the comment or string that begins here; `at` itself where neither does. A string that is not closed
// ends with its line, one of three quotes with the text.
std::size_t behind_text(const std::string& text, std::size_t at) {
  const char c = text[at];
  if (c == '#') return std::min(text.find('\n', at), text.size());
  if (c != '"' && c != '\'') return at;
  const bool many_lines = text.compare(at, 3, std::string(3, c)) == 0;
  const std::size_t width = many_lines ? 3 : 1;
  const std::string quotes(width, c);
  for (std::size_t k = at + width; k < text.size(); ++k) {
    if (!many_lines && text[k] == '\n') return k;
    if (c == '"' && text[k] == '\\' && k + 1 < text.size() && text[k + 1] != '\n') {
      ++k;
    } else if (text.compare(k, width, quotes) == 0) {
      k += width;
      for (int more = 0; many_lines && more < 2 && k < text.size() && text[k] == c; ++more) ++k;
      return k;
    }
  }
  return text.size();
}

// Visits the bytes that are in no string and no comment.
template <class Visit>
void for_bare_bytes(const std::string& text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t behind = behind_text(text, at);
    if (behind == at)
      visit(at, text[at]);
    else
      at = behind - 1;
  }
}

bool opens(char c) { return c == '[' || c == '{'; }
bool closes(char c) { return c == ']' || c == '}'; }

}  // namespace

void check_encoding(const std::string& text, const std::string& name) {
  const std::string wide = "\xff\xfe", wide_too = "\xfe\xff";
  if (text.compare(0, 2, wide) == 0 || text.compare(0, 2, wide_too) == 0)
    throw InputError(name + ":1: not TOML: UTF-16: allowed: UTF-8; save it as UTF-8");
  if (text.compare(0, 4, "\x89HDF") == 0)
    throw InputError(name +
                     ":1: not TOML: HDF5, as the results of a run: allowed: a case; that of a run is " +
                     "case.toml in its folder");
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(text, at);
    const std::string place = name + ":" + std::to_string(line) + ": not TOML: ";
    if (length == 0)
      throw InputError(place + "not UTF-8, at byte " + std::to_string(at) +
                       ": allowed: UTF-8; save it as UTF-8");
    if (text[at] == '\0')
      throw InputError(place + "a zero at byte " + std::to_string(at) +
                       ": UTF-16, or no text: allowed: UTF-8; save it as UTF-8");
    if (text[at] == '\n') ++line;
    at += length;
  }
}

void check_nesting(const std::string& text, const std::string& name) {
  int depth = 0, dots = 0;
  for_bare_bytes(text, [&](std::size_t at, char c) {
    if (c == '\n' || c == ',' || c == '=' || opens(c)) dots = 0;
    if (c == '.') ++dots;
    if (opens(c)) ++depth;
    if (closes(c) && depth > 0) --depth;
    if (dots <= most_dots && depth <= deepest_nesting) return;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw InputError(name + ":" + std::to_string(line) +
                     (dots > most_dots ? ": a key with more than " + std::to_string(most_dots) + " dots"
                                       : ": brackets nested deeper than " + std::to_string(deepest_nesting)));
  });
}

std::string with_line_feeds(std::string text) {
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

BrokenText break_long_lines(const std::string& text) {
  std::vector<std::size_t> breaks;  // behind these bytes
  std::string brackets;
  std::size_t begin = 0;
  for_bare_bytes(text, [&](std::size_t at, char c) {
    if (opens(c)) brackets += c;
    if (closes(c) && !brackets.empty()) brackets.pop_back();
    if (c == '\n') begin = at;
    if (c != ',' || at - begin < long_line || brackets.empty() || brackets.back() != '[') return;
    breaks.push_back(at);
    begin = at;
  });
  BrokenText broken;
  broken.lines.push_back({0, 1});
  auto next = breaks.begin();
  for (std::size_t at = 0; at < text.size(); ++at) {
    broken.text += text[at];
    const bool broken_here = next != breaks.end() && *next == at;
    if (broken_here) broken.text += '\n', ++next;
    if (broken_here || text[at] == '\n')
      broken.lines.push_back({broken.text.size(), broken.lines.back().number + (broken_here ? 0 : 1)});
  }
  return broken;
}

}  // namespace slagflow
