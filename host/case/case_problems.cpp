// What is wrong with a case, in the order of its file.
#include <algorithm>
#include <limits>

#include "backend/error.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {
namespace {

constexpr std::size_t most_unknown = 20, most_others = 100;  // lines

// Keys and strings of a file may hold line breaks; a problem is one line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  return text;
}

std::string line_of(const Place& place, const std::string& key, const std::string& what) {
  return place.text + ": key '" + shortened(key) + "': " + what;
}

}  // namespace

void CaseProblems::note(const std::string& key, const Place& place) { places_[key] = place; }

Place CaseProblems::place_of(const std::string& key) const {
  const auto found = places_.find(key);
  return found == places_.end() ? Place{file_, 0} : found->second;
}

void CaseProblems::add(const std::string& key, const std::string& what) {
  const Place place = place_of(key);
  faulty_.insert(key);
  problems_.push_back({place.order, line_of(place, key, what)});
}

void CaseProblems::add_unknown(const std::string& key, const std::string& what, bool before_others) {
  const Place place = place_of(key);
  problems_.push_back({before_others ? -1 : place.order, line_of(place, key, what), Kind::unknown_key});
}

void CaseProblems::add_missing(const std::string& key, const Place& place, const std::string& allowed) {
  faulty_.insert(key);
  problems_.push_back({place.order, line_of(place, key, "missing: required: " + allowed)});
}

void CaseProblems::add_message(const std::string& message) {
  problems_.push_back({std::numeric_limits<long>::max(), message});
}

bool CaseProblems::fine(std::initializer_list<std::string> keys) const {
  return std::none_of(keys.begin(), keys.end(), [&](const auto& key) { return faulty_.count(key) > 0; });
}

bool CaseProblems::fine_within(const std::string& table) const {
  const auto next = faulty_.lower_bound(table + ".");
  return next == faulty_.end() || next->rfind(table + ".", 0) != 0;
}

void CaseProblems::raise() const {
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Problem& a, const Problem& b) { return a.order < b.order; });
  std::string text;
  std::size_t unknown = 0, others = 0;
  for (const Problem& p : sorted)
    if (p.kind == Kind::unknown_key ? ++unknown <= most_unknown : ++others <= most_others)
      text += (text.empty() ? "" : "\n") + one_line(p.message);
  if (unknown > most_unknown)
    text += "\n" + file_ + ": " + std::to_string(unknown - most_unknown) + " more keys that are unknown";
  if (others > most_others)
    text += "\n" + file_ + ": " + std::to_string(others - most_others) + " more mistakes";
  throw InputError(text);
}

}  // namespace slagflow
