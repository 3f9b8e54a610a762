#include "host/case/case_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace slagflow {
namespace {

// Edits (insert, delete, replace) from a to b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// As keys are written: small letters, and _ between words.
std::string plainly(std::string text) {
  for (char& c : text)
    c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool number_of(const Toml& value, double& number) {
  if (value.is_integer())
    number = static_cast<double>(value.as_integer());
  else if (value.is_floating())
    number = value.as_floating();
  else
    return false;
  return true;
}

}  // namespace

Range any_number(const std::string& unit) {
  Range r;
  r.unit = unit;
  return r;
}

Range above(double lower, const std::string& unit) {
  Range r = any_number(unit);
  r.lower = lower, r.lower_bound = Bound::open;
  return r;
}

Range at_least(double lower, const std::string& unit) {
  Range r = any_number(unit);
  r.lower = lower;
  return r;
}

Range between(double lower, double upper, const std::string& unit) {
  Range r = at_least(lower, unit);
  r.upper = upper;
  return r;
}

Range above_to(double lower, double upper, const std::string& unit) {
  Range r = between(lower, upper, unit);
  r.lower_bound = Bound::open;
  return r;
}

Range inside(double lower, double upper, const std::string& unit) {
  Range r = above_to(lower, upper, unit);
  r.upper_bound = Bound::open;
  return r;
}

bool Range::holds(double value) const {
  if (!std::isfinite(value)) return false;
  const bool low = lower_bound == Bound::open ? value > lower : value >= lower;
  const bool high = upper_bound == Bound::open ? value < upper : value <= upper;
  return low && high;
}

std::string Range::text() const { return text(false); }

std::string Range::text_for(double value) const { return text(std::abs(value) > largest); }

std::string Range::text(bool outermost) const {
  std::string shown = "a number";
  if (lower > -largest) shown += (lower_bound == Bound::open ? " > " : " >= ") + show(lower);
  if (upper < largest || (outermost && lower > -largest)) {
    shown += lower > -largest ? " and" : "";
    shown += (upper_bound == Bound::open ? " < " : " <= ") + show(upper);
  } else if (lower <= -largest) {
    shown = "a number of magnitude up to " + show(largest);
  }
  return unit.empty() ? shown : shown + " [" + unit + "]";
}

std::string suggestion(const std::string& key, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 100, shortest_part = 4;
  if (key.size() > longest) return "";
  const std::string plain = plainly(key);
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, key.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(plain, plainly(name));
    if (distance < best) best = distance, nearest = name;
  }
  for (const std::string& name : known)
    if (nearest.empty() && std::min(plain.size(), name.size()) >= shortest_part &&
        (name.find(plain) != std::string::npos || plain.find(name) != std::string::npos))
      nearest = name;
  return nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

CaseTable::CaseTable(const Toml* table, std::string path, Place place, CaseProblems& problems)
    : table_(table), path_(std::move(path)), place_(std::move(place)), problems_(&problems) {
  if (!path_.empty() && table_) problems_->note(path_, place_);
  if (table_ && !table_->is_table()) {
    problems_->add(path_, "value " + show(*table_) + " has the wrong type: allowed: a table" +
                              (table_->is_array() ? ", [" + path_ + "], not a list" : ""));
    table_ = nullptr;
  }
}

std::string CaseTable::key_path(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

bool CaseTable::has(const char* key) const { return table_ && table_->as_table().count(key) > 0; }

bool CaseTable::set(const char* key) const {
  return has(key) && problems_->place_of(table_->as_table().at(key)).order == override_order;
}

bool CaseTable::is_list(const char* key) const { return has(key) && table_->as_table().at(key).is_array(); }

bool CaseTable::is_table(const char* key) const { return has(key) && table_->as_table().at(key).is_table(); }

void CaseTable::refuse(const char* key, const std::string& reason) {
  if (!find(key, Need::optional, "")) return;
  problem(key, "does not go with the other keys: " + reason);
}

void CaseTable::problem(const std::string& key, const std::string& what) {
  problems_->add(key.empty() ? path_ : key_path(key), what);
}

const Toml* CaseTable::find(const char* key, Need need, const std::string& allowed) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (!has(key)) {
    if (need == Need::required) problems_->add_missing(key_path(key), place_, allowed);
    return nullptr;
  }
  const Toml& value = table_->as_table().at(key);
  problems_->note(key_path(key), problems_->place_of(value));
  return &value;
}

bool CaseTable::wrong_type(const char* key, const Toml& value, const std::string& allowed) {
  problem(key, "value " + show(value) + " has the wrong type: allowed: " + allowed);
  return false;
}

bool CaseTable::beyond_numbers(const char* key, const Toml& entry, const std::string& allowed) {
  problem(key, "entry " + show(entry) + " is out of range: allowed: " + allowed + ", each " +
                   any_number("").text());
  return false;
}

bool CaseTable::read(const char* key, double& target, const Range& range, Need need) {
  const Toml* value = find(key, need, range.text());
  if (!value) return false;
  double number = 0;
  if (!number_of(*value, number)) return wrong_type(key, *value, range.text());
  if (!range.holds(number)) {
    const std::string doubt = range.doubt.empty() ? ":" : "; " + range.doubt;
    problem(key,
            "value " + show(*value) + " is out of range" + doubt + " allowed: " + range.text_for(number));
    return false;
  }
  target = number;
  return true;
}

bool CaseTable::read(const char* key, Vec3d& target, const Range& range, Need need) {
  const std::string allowed = "a list [x, y, z], each " + range.text();
  const Toml* value = find(key, need, allowed);
  if (!value) return false;
  if (!value->is_array() || value->as_array().size() != 3) return wrong_type(key, *value, allowed);
  Vec3d vector;
  for (int k = 0; k < 3; ++k) {
    const Toml& entry = value->as_array()[static_cast<std::size_t>(k)];
    if (!number_of(entry, vector[k])) return wrong_type(key, *value, allowed);
    if (!range.holds(vector[k])) {
      problem(key, "value " + show(*value) + " is out of range: allowed: " + allowed);
      return false;
    }
  }
  target = vector;
  return true;
}

bool CaseTable::read(const char* key, bool& target) {
  const Toml* value = find(key, Need::optional, "");
  if (!value) return false;
  if (!value->is_boolean()) return wrong_type(key, *value, "true or false");
  target = value->as_boolean();
  return true;
}

bool CaseTable::read(const char* key, std::string& target, Need need) {
  const Toml* value = find(key, need, "a string");
  if (!value) return false;
  if (!value->is_string()) return wrong_type(key, *value, "a string");
  target = value->as_string().str;
  return true;
}

bool CaseTable::read(const char* key, std::vector<std::string>& target) {
  const Toml* value = find(key, Need::optional, "");
  if (!value) return false;
  if (!value->is_array()) return wrong_type(key, *value, "a list of strings");
  std::vector<std::string> strings;
  for (const Toml& entry : value->as_array()) {
    if (!entry.is_string()) return wrong_type(key, *value, "a list of strings");
    strings.push_back(entry.as_string().str);
  }
  target = strings;
  return true;
}

bool CaseTable::read(const char* key, std::vector<std::array<double, 2>>& target, const std::string& allowed,
                     Need need) {
  const Toml* value = find(key, need, allowed);
  if (!value) return false;
  if (!value->is_array()) return wrong_type(key, *value, allowed);
  std::vector<std::array<double, 2>> rows;
  for (const Toml& row : value->as_array()) {
    rows.emplace_back();
    if (!row.is_array() || row.as_array().size() != 2 || !number_of(row.as_array()[0], rows.back()[0]) ||
        !number_of(row.as_array()[1], rows.back()[1]))
      return wrong_type(key, *value, allowed);
  }
  target = rows;
  return true;
}

bool CaseTable::read(const char* key, std::vector<Vec3d>& target, const std::string& allowed) {
  const Toml* value = find(key, Need::optional, allowed);
  if (!value) return false;
  if (!value->is_array()) return wrong_type(key, *value, allowed);
  std::vector<Vec3d> rows;
  for (const Toml& row : value->as_array()) {
    rows.emplace_back();
    if (!row.is_array() || row.as_array().size() != 3) return wrong_type(key, *value, allowed);
    for (int k = 0; k < 3; ++k) {
      if (!number_of(row.as_array()[static_cast<std::size_t>(k)], rows.back()[k]))
        return wrong_type(key, *value, allowed);
      if (!any_number("").holds(rows.back()[k])) return beyond_numbers(key, row, allowed);
    }
  }
  target = rows;
  return true;
}

bool CaseTable::read(const char* key, std::vector<double>& target, const std::string& allowed, Need need) {
  const Toml* value = find(key, need, allowed);
  if (!value) return false;
  if (!value->is_array()) return wrong_type(key, *value, allowed);
  std::vector<double> numbers;
  for (const Toml& entry : value->as_array()) {
    numbers.emplace_back();
    if (!number_of(entry, numbers.back())) return wrong_type(key, *value, allowed);
    if (!any_number("").holds(numbers.back())) return beyond_numbers(key, entry, allowed);
  }
  target = numbers;
  return true;
}

bool CaseTable::holds_number(const char* key) {
  const Toml* value = find(key, Need::optional, "a number");
  return value && (value->is_floating() || value->is_integer());
}

bool CaseTable::says(const char* key, const std::string& word) {
  const Toml* value = find(key, Need::optional, word);
  return value && value->is_string() && value->as_string().str == word;
}

bool CaseTable::read_integer(const char* key, int& target, int lower, int upper) {
  const std::string allowed = "an integer from " + std::to_string(lower) + " to " + std::to_string(upper);
  const Toml* value = find(key, Need::optional, allowed);
  if (!value) return false;
  if (!value->is_integer()) return wrong_type(key, *value, allowed);
  if (value->as_integer() < lower || value->as_integer() > upper) {
    problem(key, "value " + show(*value) + " is out of range: allowed: " + allowed);
    return false;
  }
  target = static_cast<int>(value->as_integer());
  return true;
}

bool CaseTable::read_choice(const char* key, int& target, const std::vector<std::string>& names, Need need) {
  const std::string allowed = join(names);
  const Toml* value = find(key, need, allowed);
  if (!value) return false;
  if (!value->is_string()) return wrong_type(key, *value, allowed);
  const std::string& name = value->as_string().str;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    problem(key, "value " + show(*value) + " is unknown: " + suggestion(name, names) + "allowed: " + allowed);
    return false;
  }
  target = static_cast<int>(found - names.begin());
  return true;
}

CaseTable CaseTable::table(const char* key) {
  const Toml* value = find(key, Need::optional, "");
  return CaseTable(value, key_path(key), value ? problems_->place_of(*value) : place_, *problems_);
}

std::vector<CaseTable> CaseTable::tables(const char* key, Need need) {
  std::vector<CaseTable> result;
  const std::string allowed = "a list of tables with at least one entry";
  const Toml* value = find(key, need, allowed);
  if (!value) return result;
  if (!value->is_array()) {
    wrong_type(key, *value,
               std::string("a list of tables") + (value->is_table() ? ", [[" + key_path(key) + "]]" : ""));
    return result;
  }
  if (value->as_array().empty() && need == Need::required)
    problem(key, "value [] is empty: allowed: " + allowed);
  for (const Toml& entry : value->as_array())
    result.emplace_back(&entry, key_path(key) + "." + std::to_string(result.size()),
                        problems_->place_of(entry), *problems_);
  return result;
}

std::vector<std::pair<std::string, CaseTable>> CaseTable::named_tables(const char* key, Need need) {
  std::vector<std::pair<std::string, CaseTable>> result;
  const std::string allowed = std::string("at least one table [") + key + ".NAME]";
  const Toml* value = find(key, need, allowed);
  if (!value) return result;
  if (!value->is_table()) {
    wrong_type(key, *value, allowed);
    return result;
  }
  if (value->as_table().empty() && need == Need::required) problem(key, "is empty: allowed: " + allowed);
  for (const auto& [name, entry] : value->as_table())
    result.emplace_back(
        name, CaseTable(&entry, key_path(key) + "." + name, problems_->place_of(entry), *problems_));
  const auto earlier = [](const auto& a, const auto& b) {
    return a.second.place_.order < b.second.place_.order;
  };
  std::stable_sort(result.begin(), result.end(), earlier);
  return result;
}

std::vector<std::string> CaseTable::unknown() const {
  std::vector<std::string> names;
  if (!table_) return names;
  for (const auto& [name, value] : table_->as_table())
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) names.push_back(name);
  return names;
}

// Tables of the top level go first: what is missing in their place follows.
void CaseTable::report_unknown(const std::string& name, const std::string& what) {
  problems_->note(key_path(name), problems_->place_of(table_->as_table().at(name)));
  problems_->add_unknown(key_path(name), "unknown: " + what, path_.empty());
}

}  // namespace slagflow
