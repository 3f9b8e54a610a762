#include "host/case/case_changes.hpp"

#include <map>

#include "host/case/toml_reader.hpp"

namespace slagflow {
namespace {

using Values = std::map<std::string, std::string>;

bool is_list_of_tables(const Toml& value) {
  return value.is_array() && !value.as_array().empty() && value.as_array().front().is_table();
}

// All of it, where show() cuts what is long.
std::string whole_text(const Toml& value) {
  if (value.is_string()) return "\"" + value.as_string().str + "\"";
  if (!value.is_array()) return show(value);
  std::string text;
  for (const Toml& entry : value.as_array()) text += (text.empty() ? "[" : ", ") + whole_text(entry);
  return text.empty() ? "[]" : text + "]";
}

void collect(const Toml& value, const std::string& path, Values& values) {
  const std::string before = path.empty() ? "" : path + ".";
  if (value.is_table()) {
    for (const auto& [name, inside] : value.as_table()) collect(inside, before + name, values);
  } else if (is_list_of_tables(value)) {
    std::size_t number = 0;
    for (const Toml& entry : value.as_array()) collect(entry, before + std::to_string(number++), values);
  } else {
    values[path] = whole_text(value);
  }
}

Values values_of(const Case& c) {
  Values values;
  TomlFile file(to_toml(c), c.file);
  collect(file.root(), "", values);
  return values;
}

std::string shown(const std::string& value) { return value.empty() ? "nothing" : value; }

}  // namespace

std::vector<KeyChange> key_changes(const Case& before, const Case& after) {
  const Values old = values_of(before), now = values_of(after);
  std::map<std::string, KeyChange> changes;
  for (const auto& [key, value] : old) changes[key] = {key, value, ""};
  for (const auto& [key, value] : now) changes[key] = {key, changes[key].before, value};
  std::vector<KeyChange> result;
  for (const auto& [key, change] : changes)
    if (change.before != change.after) result.push_back(change);
  return result;
}

std::string text_of(const KeyChange& change) {
  return change.key + " " + shown(change.before) + " -> " + shown(change.after);
}

std::string as_assignment(const KeyChange& change) { return shell_word(change.key + "=" + change.after); }

std::string shell_word(const std::string& text) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace slagflow
