// What is wrong with a case, in the order of its file.
#include <algorithm>
#include <limits>

#include "backend/error.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {
namespace {

// Keys and strings of a file may hold line breaks; a problem is one line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  return text;
}

}  // namespace

void CaseProblems::note(const std::string& key, const Place& place) { places_[key] = place; }

void CaseProblems::add(const std::string& key, const std::string& what) {
  const auto found = places_.find(key);
  const Place place = found == places_.end() ? Place{file_, 0} : found->second;
  faulty_.insert(key);
  problems_.push_back({place.order, place.text + ": key '" + key + "': " + what});
}

void CaseProblems::add_missing(const std::string& key, const Place& place, const std::string& allowed) {
  faulty_.insert(key);
  problems_.push_back({place.order, place.text + ": key '" + key + "': missing: required: " + allowed});
}

void CaseProblems::add_message(const std::string& message) {
  problems_.push_back({std::numeric_limits<long>::max(), message});
}

bool CaseProblems::fine(std::initializer_list<std::string> keys) const {
  return std::none_of(keys.begin(), keys.end(), [&](const auto& key) { return faulty_.count(key) > 0; });
}

void CaseProblems::raise() const {
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Problem& a, const Problem& b) { return a.order < b.order; });
  std::string text;
  for (const Problem& p : sorted) text += (text.empty() ? "" : "\n") + one_line(p.message);
  throw InputError(text);
}

}  // namespace slagflow
