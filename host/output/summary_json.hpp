// A JSON value, for the summary of a run and the schema of cases. Keys keep the order in which they were
// added.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace slagflow {

class Json {
 public:
  using Object = std::vector<std::pair<std::string, Json>>;
  using Array = std::vector<Json>;

  Json() = default;  // null
  Json(bool value) : value_(value) {}
  Json(double value) : value_(value) {}  // infinite and not-a-number: null
  Json(int value) : value_(static_cast<std::int64_t>(value)) {}
  Json(std::int64_t value) : value_(value) {}
  Json(std::size_t value) : value_(static_cast<std::int64_t>(value)) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  Json(Object object) : value_(std::move(object)) {}
  Json(Array array) : value_(std::move(array)) {}
  static Json object() { return Json(Object{}); }

  // Of an object: appends, or replaces the value of a key that is there. Returns itself for the next.
  Json& set(const std::string& key, Json value);
  // Of an object: the value of a key; null when it is not there.
  const Json& at(const std::string& key) const;
  const Object& entries() const;  // of an object

  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  double number() const;  // not-a-number unless it is one
  // As text, indented by two blanks a level.
  std::string text(int level = 0) const;

 private:
  std::variant<std::monostate, double, std::int64_t, std::string, Object, bool, Array> value_;
};

}  // namespace slagflow
