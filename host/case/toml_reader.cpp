#include "host/case/toml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <sstream>

#include "backend/error.hpp"

namespace slagflow {
namespace {

const std::string override_prefix = "--set ";
constexpr long after_every_line = 1000000000;

// The parser recurses for every bracket and every part of a dotted key; a hostile file must not exhaust
// the stack.
constexpr int deepest_nesting = 200, most_dots = 10000;

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

// The parser reads beyond its text where that is not UTF-8.
void check_encoding(const std::string& text, const std::string& name) {
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(text, at);
    if (length == 0) throw InputError(name + ":" + std::to_string(line) + ": not TOML: not UTF-8");
    if (text[at] == '\n') ++line;
    at += length;
  }
}

void check_nesting(const std::string& text, const std::string& name) {
  int depth = 0, line = 1, dots = 0;
  for (const char c : text) {
    if (c == '\n') ++line, dots = 0;
    if (c == '.' && ++dots > most_dots)
      throw InputError(name + ":" + std::to_string(line) + ": more than " + std::to_string(most_dots) +
                       " dots on one line");
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > deepest_nesting)
      throw InputError(name + ":" + std::to_string(line) + ": brackets nested deeper than " +
                       std::to_string(deepest_nesting));
  }
}

// The parser's first line without its own function names: "[error] toml::parse_x: what".
std::string reason(const std::string& what) {
  std::string text = what.substr(0, what.find('\n'));
  for (const std::string& prefix : {std::string("[error] "), std::string("toml::")})
    if (text.rfind(prefix, 0) == 0) text = text.substr(prefix.size());
  const auto colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A number at a point that lacks a digit on one side, ".5" or "5.", written out; empty where there is none.
std::string written_out(const std::string& text, std::size_t point) {
  const auto at = [&](std::size_t k) { return k < text.size() ? text[k] : ' '; };
  const auto bounds = [](char c) { return std::string(" \t\r=,[]}#").find(c) != std::string::npos; };
  std::size_t begin = point, end = point + 1;
  while (begin > 0 && is_digit(text[begin - 1])) --begin;
  const std::size_t whole = begin;
  if (begin > 0 && (text[begin - 1] == '-' || text[begin - 1] == '+')) --begin;
  while (is_digit(at(end))) ++end;
  const std::size_t fraction = end;
  if (at(end) == 'e' || at(end) == 'E') {
    ++end;
    if (at(end) == '-' || at(end) == '+') ++end;
    while (is_digit(at(end))) ++end;
  }
  const bool no_whole = whole == point, no_fraction = fraction == point + 1;
  if (no_whole == no_fraction || (begin > 0 && !bounds(text[begin - 1])) || !bounds(at(end))) return "";
  const std::string zero = "0";
  return text.substr(begin, whole - begin) + (no_whole ? zero : "") + text.substr(whole, fraction - whole) +
         (no_fraction ? zero : "") + text.substr(fraction, end - fraction);
}

// Of a line "key = value" with a decimal comma, points between thousands, or a word without quotes; empty for
// others.
std::string advice_on_value(const std::string& line) {
  static const std::regex comma(R"(=\s*([-+]?\d+),(\d+)\s*(#.*)?$)"),
      word(R"(=\s*([A-Za-z][\w-]*)\s*(#.*)?$)"),
      thousands(R"(=\s*([-+]?\d{1,3}(,\d{3})+(\.\d*)?)\s*(#.*)?$)");
  std::smatch found;
  if (std::regex_search(line, found, thousands)) {
    std::string plain = found[1];
    plain.erase(std::remove(plain.begin(), plain.end(), ','), plain.end());
    return "; no commas in numbers: write " + plain +
           (found[3].length() == 0 ? ", or with a decimal point" : "");
  }
  if (std::regex_search(line, found, comma))
    return "; a decimal point, not a comma: write " + found[1].str() + "." + found[2].str();
  if (std::regex_search(line, found, word))
    return "; words stand in quotes: write \"" + found[1].str() + "\"";
  return "";
}

// What to write instead of the first such number outside of strings; empty without one.
std::string advice(const std::string& line) {
  if (std::string better = advice_on_value(line); !better.empty()) return better;
  char quote = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '#')
      break;
    else if (c == '.')
      if (const std::string number = written_out(line, k); !number.empty())
        return "; a number has a digit on both sides of its point: write " + number;
  }
  return "";
}

std::string line_of(const std::string& text, std::size_t number) {
  std::size_t begin = 0;
  for (; number > 1 && begin != std::string::npos; --number)
    begin = text.find('\n', begin) == std::string::npos ? std::string::npos : text.find('\n', begin) + 1;
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

Toml parse_stream(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  return toml::parse<toml::discard_comments, std::map, std::vector>(stream, name);
}

Toml parse_override_value(const std::string& text, const std::string& name) {
  try {
    check_encoding(text, name);
    check_nesting(text, name);
    if (text.find('\n') == std::string::npos) return parse_stream("v = " + text, name).at("v");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception&) {
    // Not TOML: a bare word such as jacobi is taken as a string.
    if (const std::string better = advice(text); !better.empty())
      throw InputError(name + ": not TOML" + better);
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return parse_stream("v = " + quoted + "\"", name).at("v");
}

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Toml& list_entry(Toml& list, const std::string& part, const std::string& name) {
  auto& entries = list.as_array();
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (failure != std::errc() || end != part.data() + part.size() || index >= entries.size())
    throw InputError(name + ": '" + part + "' is not an entry of this list: allowed: " +
                     (entries.empty() ? "none, it is empty" : "0 to " + std::to_string(entries.size() - 1)));
  return entries[index];
}

// The value a part of a dotted key leads to, made when a table lacks it.
Toml& child(Toml& node, const std::string& part, const std::string& name) {
  if (part.empty()) throw InputError(name + ": empty part in the key");
  if (node.is_array()) return list_entry(node, part, name);
  if (!node.is_table())
    throw InputError(name + ": '" + part + "' cannot be set inside the value " + show(node));
  auto& table = node.as_table();
  const auto found = table.find(part);
  if (found != table.end()) return found->second;
  return table.emplace(part, parse_override_value("{}", name)).first->second;
}

}  // namespace

Toml parse_toml(const std::string& text, const std::string& name) {
  check_encoding(text, name);
  check_nesting(text, name);
  try {
    return parse_stream(text, name);
  } catch (const toml::exception& e) {
    const std::string line = line_of(text, e.location().line());
    constexpr std::size_t most_shown = 80;
    throw InputError(name + ":" + std::to_string(e.location().line()) + ": not TOML: " + reason(e.what()) +
                     ", in \"" + line.substr(0, most_shown) + "\"" + advice(line));
  } catch (const std::exception& e) {
    throw InputError(name + ": not TOML: " + reason(e.what()));
  }
}

void apply_override(Toml& root, const std::string& assignment) {
  const std::string name = override_prefix + assignment;
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(name + ": allowed: --set dotted.key=value");
  Toml* node = &root;
  for (const std::string& part : split_key(assignment.substr(0, equals))) node = &child(*node, part, name);
  *node = parse_override_value(assignment.substr(equals + 1), name);
}

Place place_of(const Toml& value) {
  const auto location = value.location();
  const std::string& name = location.file_name();
  if (name.rfind(override_prefix, 0) == 0) return {name, after_every_line};
  return {name + ":" + std::to_string(location.line()), static_cast<long>(location.line())};
}

std::string show(double number) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : (number > 0 ? "inf" : "-inf");
  char text[40];
  const auto result = std::to_chars(text, text + sizeof text, number);
  std::string shown(text, result.ptr);
  if (shown.find_first_of(".e") == std::string::npos) shown += ".0";
  return shown;
}

std::string show(const Toml& value) {
  if (value.is_floating()) return show(value.as_floating());
  if (value.is_string()) return "\"" + value.as_string().str + "\"";
  if (value.is_table()) return "{...}";
  if (!value.is_array()) return toml::format(value);
  std::string shown = "[";
  for (const Toml& entry : value.as_array()) {
    if (shown.size() > 60) return shown + ", ...]";
    if (shown.size() > 1) shown += ", ";
    shown += show(entry);
  }
  return shown + "]";
}

}  // namespace slagflow
