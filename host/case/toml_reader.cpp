#include "host/case/toml_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include "backend/error.hpp"

namespace slagflow {
namespace {

const std::string override_prefix = "--set ";
constexpr std::size_t longest_advised = 1000;  // [bytes] of a line

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

// Characters that word processors put in place of those of TOML; empty without one.
std::string advice_on_characters(const std::string& line) {
  struct Character {
    const char *bytes, *advice;
  };
  constexpr std::array<Character, 9> characters{
      {{"\u201c", "straight quotes: write \""},
       {"\u201d", "straight quotes: write \""},
       {"\u201e", "straight quotes: write \""},
       {"\u2018", "straight quotes: write '"},
       {"\u2019", "straight quotes: write '"},
       {"\u00ab", "straight quotes: write \""},
       {"\u2212", "a minus sign from the keyboard: write -"},
       {"\u2013", "a minus sign from the keyboard: write -"},
       {"\u00a0", "it holds a no-break space: write a common one"}}};
  for (const Character& c : characters)
    if (line.find(c.bytes) != std::string::npos) return std::string("; ") + c.advice;
  return "";
}

// Of a line "key = value" with a decimal comma, points between thousands, a unit, Fortran's exponent, or a
// word without quotes; empty for others.
std::string advice_on_value(const std::string& line) {
  static const std::regex comma(R"(=\s*([-+]?\d+),(\d+)\s*(#.*)?$)"),
      word(R"(=\s*([A-Za-z][\w-]*)\s*(#.*)?$)"),
      thousands(R"(=\s*([-+]?\d{1,3}(,\d{3})+(\.\d*)?)\s*(#.*)?$)"),
      exponent(R"(=\s*([-+]?\d+(\.\d*)?)[dD]([-+]?\d+)\s*(#.*)?$)"),
      unit(R"(=\s*([-+]?\d+(\.\d+)?([eE][-+]?\d+)?)\s*([A-Za-z%][^#"',=]*)(#.*)?$)");
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
  if (std::regex_search(line, found, exponent))
    return "; the exponent has an e: write " + found[1].str() + "e" + found[3].str();
  if (std::regex_search(line, found, unit) && found[4].str().find_first_of("xXob") != 0)
    return "; numbers stand without a unit: write " + found[1].str() +
           ", in the unit that slagflow help tells";
  if (std::count(line.begin(), line.end(), '{') > std::count(line.begin(), line.end(), '}'))
    return "; a table in braces stands on one line";
  return "";
}

// What other languages have and TOML has not.
std::string advice_on_habits(const std::string& line) {
  struct Habit {
    std::regex sign;
    const char* advice;
  };
  static const std::array<Habit, 5> habits{
      {{std::regex(R"(=\s*[-+]?\d{1,3}(\.\d{3})+(,\d*)\s*(#.*)?$)"),
        "a decimal point, and nothing between thousands"},
       {std::regex(R"(=\s*(True|False|TRUE|FALSE|[Yy]es|[Nn]o|YES|NO|[Oo]n|[Oo]ff|ON|OFF)\s*([,}\]#]|$))"),
        "true and false are written so"},
       {std::regex(R"(^[^#"']*//)"), "a comment begins with #"},
       {std::regex(R"(;\s*(#.*)?$)"), "a line ends without a semicolon"},
       {std::regex(R"(=\s*[-+\d.eE]+\s*([*/^(]|\xC2\xB7|\xC3\x97))"),
        "no arithmetic: write the number, as 2.6e3"}}};
  for (const Habit& habit : habits)
    if (std::regex_search(line, habit.sign)) return std::string("; ") + habit.advice;
  return "";
}

// A path of Windows in double quotes, where a backslash begins an escape.
std::string advice_on_backslashes(const std::string& line) {
  static const std::regex path(R"("[^"]*([A-Za-z]:\\|\\[^btnfr"\\uU]|\\[uU](?![0-9A-Fa-f]{4}))[^"]*")");
  if (!std::regex_search(line, path)) return "";
  return "; a backslash in \"...\" begins an escape: write / in paths, or single quotes '...'";
}

// What to write instead of the first such number outside of strings; empty without one.
std::string advice(const std::string& line, const std::string& fault = "") {
  if (std::string better = advice_on_characters(line); !better.empty()) return better;
  if (line.size() > longest_advised) return "";  // the search for others recurses with the length
  static const std::regex other_line(R"(^\s*(\[|$))");
  if (fault.find("missing array separator") != std::string::npos && std::regex_search(line, other_line))
    return "; a bracket above it is not closed";
  if (std::string better = advice_on_backslashes(line); !better.empty()) return better;
  if (std::string better = advice_on_habits(line); !better.empty()) return better;
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
    const bool number = text.find_first_not_of("+-.,0123456789") == std::string::npos;
    if (const std::string better = advice(number ? "v = " + text : text); !better.empty())
      throw InputError(name + ": not TOML" + better);
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return parse_stream("v = " + quoted + "\"", name).at("v");
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
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

// Of the entry that has this name, or nothing.
std::string number_of(const std::vector<Toml>& entries, const std::string& name) {
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!entries[k].is_table()) continue;
    const auto found = entries[k].as_table().find("name");
    if (found != entries[k].as_table().end() && found->second.is_string() &&
        found->second.as_string().str == name)
      return "; entries go by number, and " + in_quotes(name) + " is " + std::to_string(k);
  }
  return "";
}

Toml& list_entry(Toml& list, const std::string& part, const std::string& name) {
  auto& entries = list.as_array();
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (failure != std::errc() || end != part.data() + part.size() || index >= entries.size())
    throw InputError(name + ": '" + part + "' is not an entry of this list: allowed: " +
                     (entries.empty() ? "none, it is empty" : "0 to " + std::to_string(entries.size() - 1)) +
                     number_of(entries, part));
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

TomlFile::TomlFile(const std::string& given, const std::string& name) : name_(name) {
  const std::string text = with_line_feeds(given);
  check_encoding(text, name);
  check_nesting(text, name);
  const BrokenText broken = break_long_lines(text);
  lines_ = broken.lines;
  try {
    root_ = parse_stream(broken.text, name);
  } catch (const toml::exception& e) {
    const long line = number_of(e.location().line());
    throw InputError(name + ":" + std::to_string(line) + ": not TOML: " + shortened(reason(e.what()), 200) +
                     ", in " + in_quotes(line_of(text, static_cast<std::size_t>(line))) +
                     advice(line_of(text, static_cast<std::size_t>(line)), e.what()));
  } catch (const std::exception& e) {
    throw InputError(name + ": not TOML: " + reason(e.what()));
  }
}

long TomlFile::number_of(std::size_t parsed_line) const {
  return parsed_line >= 1 && parsed_line <= lines_.size() ? lines_[parsed_line - 1].number : 1;
}

// The parser would count all lines before a value anew.
Place TomlFile::place_of(const Toml& value) const {
  const auto* const region = dynamic_cast<const toml::detail::region*>(toml::detail::get_region(value));
  if (!region) return {name_ + ":1", 1};
  if (region->name().rfind(override_prefix, 0) == 0) return {region->name(), override_order};
  const auto at = static_cast<std::size_t>(region->first() - region->begin());
  const auto next =
      std::upper_bound(lines_.begin(), lines_.end(), at,
                       [](std::size_t offset, const TextLine& line) { return offset < line.begin; });
  const long line = number_of(static_cast<std::size_t>(next - lines_.begin()));
  return {name_ + ":" + std::to_string(line), line};
}

void apply_override(Toml& root, const std::string& assignment) {
  const std::string name = override_prefix + shortened(assignment);
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(name + ": allowed: --set dotted.key=value");
  Toml* node = &root;
  for (const std::string& part : split_key(trimmed(assignment.substr(0, equals))))
    node = &child(*node, part, name);
  *node = parse_override_value(assignment.substr(equals + 1), name);
}

std::string show(double number) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : (number > 0 ? "inf" : "-inf");
  char text[40];
  const auto result = std::to_chars(text, text + sizeof text, number);
  std::string shown(text, result.ptr);
  if (shown.find_first_of(".e") == std::string::npos) shown += ".0";
  return shown;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // within a character
  return text.substr(0, end) + "...";
}

std::string in_quotes(const std::string& text) { return "\"" + shortened(text) + "\""; }

namespace {

// What a double does not hold becomes its largest or 0: then as the file has it.
std::string show_as_given(const Toml& value) {
  const double number = value.as_floating();
  const auto* const region = dynamic_cast<const toml::detail::region*>(toml::detail::get_region(value));
  const bool lost = number == 0 || std::abs(number) == std::numeric_limits<double>::max();
  return lost && region ? shortened(region->str()) : show(number);
}

}  // namespace

std::string show(const Toml& value) {
  if (value.is_floating()) return show_as_given(value);
  if (value.is_string()) return in_quotes(value.as_string().str);
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
