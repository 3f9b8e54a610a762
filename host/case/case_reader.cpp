#include "host/case/case_reader.hpp"

#include <algorithm>

#include "host/case/case_catalogue.hpp"

namespace slagflow {
namespace {

// The range with the word that may stand for a number beside its unit.
Range with_word(const Key& k, Range range) {
  if (!*k.word) return range;
  if (!range.unit.empty()) range.unit += ", ";
  range.unit += "or \"" + std::string(k.word) + "\"";
  return range;
}

// As a file heads it: [numerics], [fluid.NAME], [[region]]; empty for tables without a line of their own.
std::string heading(const std::string& table) {
  for (const CatalogueKey* k : catalogue().in(""))
    if (k->inside == table) return k->form == Form::list ? "[[" + k->name + "]]" : "[" + table + "]";
  return "";
}

// A table that has a key of this name.
std::string elsewhere(const std::string& name) {
  for (const CatalogueKey& k : catalogue().keys())
    if (k.name == name && !k.is_table() && !heading(k.table).empty())
      return "; " + name + " is a key of " + heading(k.table);
  return "";
}

}  // namespace

CaseReader::CaseReader(const Toml& root, const Place& place, CaseProblems& problems) {
  frames_.push_back({CaseTable(&root, "", place, problems), ""});
}

bool CaseReader::number(const Key& k, double& target, const Range& range) {
  if (*k.word && here().says(k.name, k.word)) {
    target = k.word_value;
    return true;
  }
  return here().read(k.name, target, with_word(k, range), k.need);
}

bool CaseReader::vector(const Key& k, Vec3d& target, const Range& range) {
  return here().read(k.name, target, range, k.need);
}

bool CaseReader::integer(const Key& k, int& target, Integers range) {
  return here().read_integer(k.name, target, range.lower, range.upper);
}

bool CaseReader::flag(const Key& k, bool& target) { return here().read(k.name, target); }

bool CaseReader::text(const Key& k, std::string& target) { return here().read(k.name, target, k.need); }

bool CaseReader::numbers(const Key& k, std::vector<double>& target, const std::string& allowed) {
  return here().read(k.name, target, allowed, k.need);
}

bool CaseReader::vectors(const Key& k, std::vector<Vec3d>& target, const std::string& allowed) {
  return here().read(k.name, target, allowed);
}

bool CaseReader::pairs(const Key& k, Rows& target, const std::string& allowed) {
  if (!here().read(k.name, target, allowed, k.need)) return false;
  for (const auto& row : target)
    if (!any_number("").holds(row[0]) || !any_number("").holds(row[1])) {
      problem(k.name,
              "row [" + show(row[0]) + ", " + show(row[1]) + "] is out of range: allowed: " + allowed);
      return false;
    }
  return true;
}

bool CaseReader::choices(const Key& k, bool* chosen, const Words& words, const char* one) {
  Words given;
  if (!here().read(k.name, given)) return false;
  for (const std::string& word : given) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
      problem(k.name, "value " + in_quotes(word) + " is not " + one + ": allowed: " + join(words));
    else
      chosen[found - words.begin()] = true;
  }
  return true;
}

bool CaseReader::number_or_rows(const Key& k, double& target, const Range& range, Rows& rows,
                                const std::string& allowed) {
  if (!here().is_list(k.name)) return number(k, target, range);
  if (!here().read(k.name, rows, allowed)) return false;
  if (rows.empty()) problem(k.name, "value [] is empty: allowed: " + allowed);
  return !rows.empty();
}

bool CaseReader::choice(const Key& k, int& index, const Words& words) {
  const bool known =
      here().read_choice(k.name, index, words, k.need) || (k.need == Need::optional && !here().has(k.name));
  if (!known) frames_.back().undecided.push_back(k.name);
  return known;
}

bool CaseReader::reference(const Key& k, int& index, const Words& names, const char* one) {
  // Without anything to name, that itself is reported.
  if (names.empty() && !here().has(k.name) && k.need == Need::optional) return false;
  const Words none{std::string("none, as the case does not have ") + one};
  return here().read_choice(k.name, index, names.empty() ? none : names, k.need) && !names.empty();
}

bool CaseReader::choice_or_number(const Key& k, int& index, const Words& words, double& target,
                                  const Range& range) {
  if (!here().holds_number(k.name)) return here().read_choice(k.name, index, words, k.need);
  if (!number(k, target, range)) return false;
  index = static_cast<int>(words.size());
  return true;
}

bool CaseReader::given(std::initializer_list<const char*> keys) const {
  const CaseTable& table = frames_.back().table;
  return std::any_of(keys.begin(), keys.end(), [&](const char* name) { return table.has(name); });
}

void CaseReader::problem(const std::string& name, const std::string& what) { here().problem(name, what); }

void CaseReader::enter(CaseTable table, const std::string& described) {
  frames_.push_back({std::move(table), described});
}

void CaseReader::enter_table(const Key& k) {
  enter(here().table(k.name), within(frames_.back().described, k.name));
}

bool CaseReader::enter_inline(const Key& k) {
  const bool there = here().has(k.name);
  const CaseTable table = here().table(k.name);
  if (there) enter(table, within(frames_.back().described, k.name));
  return there;
}

std::size_t CaseReader::enter_list(const Key& k, std::size_t, const char* of) {
  List list;
  list.described = *of ? of : within(frames_.back().described, std::string(k.name) + ".N");
  for (CaseTable& table : here().tables(k.name, k.need)) list.entries.emplace_back("", table);
  lists_.push_back(list);
  return list.entries.size();
}

void CaseReader::enter_entry(std::size_t index) {
  enter(lists_.back().entries[index].second, lists_.back().described);
}

std::size_t CaseReader::enter_named(const Key& k, std::size_t) {
  lists_.push_back(
      {here().named_tables(k.name, k.need), within(frames_.back().described, std::string(k.name) + ".NAME")});
  return lists_.back().entries.size();
}

void CaseReader::enter_named_entry(std::size_t index, std::string& name) {
  name = lists_.back().entries[index].first;
  enter_entry(index);
  if (!here().from_override()) return;
  Words others;
  for (const auto& [other, table] : lists_.back().entries)
    if (!table.from_override()) others.push_back(other);
  frames_.back().meant = suggestion(name, others);
}

void CaseReader::leave() {
  report_unknown(frames_.back());
  if (!frames_.back().meant.empty() && here().faulty())
    problem("", "is not in the file: " + frames_.back().meant +
                    "allowed: a name of the file, or all keys of a new table");
  frames_.pop_back();
}

void CaseReader::leave_list() { lists_.pop_back(); }

void CaseReader::finish() { report_unknown(frames_.back()); }

bool CaseReader::undecided(const Frame& frame, const CatalogueKey& k) {
  return std::any_of(k.where.begin(), k.where.end(), [&](const Where& where) {
    return std::find(frame.undecided.begin(), frame.undecided.end(), where.what) != frame.undecided.end();
  });
}

// Whether a word that is given, and not what the reason is about, keeps the key out.
bool CaseReader::kept_out_by_word(Frame& frame, const CatalogueKey& k) {
  for (std::size_t c = 0; c < k.where.size(); ++c) {
    const Where& where = k.where[c];
    if (c == k.reason_of || where.words.empty() || !frame.table.has(where.what.c_str())) continue;
    if (std::none_of(where.words.begin(), where.words.end(),
                     [&](const std::string& word) { return frame.table.says(where.what.c_str(), word); }))
      return true;
  }
  return false;
}

// What was asked for, and what would be if the choices were known.
Words CaseReader::allowed_in(const Frame& frame) {
  Words allowed = frame.table.known();
  if (frame.undecided.empty()) return allowed;
  for (const CatalogueKey* k : catalogue().in(frame.described))
    if (undecided(frame, *k) && std::find(allowed.begin(), allowed.end(), k->name) == allowed.end())
      allowed.push_back(k->name);
  return allowed;
}

// Keys that go with other choices have their reason; where the choice is not known, they are passed over.
void CaseReader::report_unknown(Frame& frame) {
  const std::vector<std::string> unknown = frame.table.unknown();
  if (unknown.empty()) return;
  const Words allowed = allowed_in(frame);
  const std::string all = "allowed: " + join(allowed);
  for (const std::string& name : unknown) {
    const CatalogueKey* const known = catalogue().find(frame.described, name);
    if (known && undecided(frame, *known)) continue;
    if (known && !known->reason.empty() && !kept_out_by_word(frame, *known))
      frame.table.refuse(name.c_str(), known->reason);
    else if (known)
      frame.table.report_unknown(name, all + "; " + name + " goes with " + known->where_text());
    else
      frame.table.report_unknown(name, suggestion(name, allowed) + all + elsewhere(name));
  }
}

}  // namespace slagflow
