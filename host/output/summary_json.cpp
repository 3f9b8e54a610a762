#include "host/output/summary_json.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace slagflow {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(c));
      out += code.data();
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

// On one line where nothing in it needs more.
std::string array_text(const Json::Array& array, int level) {
  std::string out;
  for (const Json& value : array) out += (out.empty() ? "" : ", ") + value.text(level);
  return "[" + out + "]";
}

}  // namespace

Json& Json::set(const std::string& key, Json value) {
  for (auto& [name, present] : std::get<Object>(value_)) {
    if (name == key) return present = std::move(value), *this;
  }
  std::get<Object>(value_).emplace_back(key, std::move(value));
  return *this;
}

const Json& Json::at(const std::string& key) const {
  static const Json null;
  for (const auto& [name, value] : entries()) {
    if (name == key) return value;
  }
  return null;
}

const Json::Object& Json::entries() const { return std::get<Object>(value_); }

double Json::number() const {
  if (const auto* integer = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*integer);
  const auto* real = std::get_if<double>(&value_);
  return real != nullptr ? *real : std::numeric_limits<double>::quiet_NaN();
}

std::string Json::text(int level) const {
  if (const auto* real = std::get_if<double>(&value_)) return number_text(*real);
  if (const auto* integer = std::get_if<std::int64_t>(&value_)) return std::to_string(*integer);
  if (const auto* string = std::get_if<std::string>(&value_)) return quoted(*string);
  if (const auto* flag = std::get_if<bool>(&value_)) return *flag ? "true" : "false";
  if (const auto* array = std::get_if<Array>(&value_)) return array_text(*array, level);
  if (is_null()) return "null";
  if (entries().empty()) return "{}";
  const std::string indent(2 * static_cast<std::size_t>(level) + 2, ' ');
  std::string out = "{";
  for (const auto& [name, value] : entries())
    out += (out.size() > 1 ? ",\n" : "\n") + indent + quoted(name) + ": " + value.text(level + 1);
  return out + "\n" + std::string(2 * static_cast<std::size_t>(level), ' ') + "}";
}

}  // namespace slagflow
