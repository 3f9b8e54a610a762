#include "host/case/case_catalogue.hpp"

#include <algorithm>

#include "backend/error.hpp"
#include "host/case/case_keys.hpp"

namespace slagflow {
namespace {

std::string quoted_list(const Words& words, const char* separator) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "\"" : separator + std::string("\"")) + word + "\"";
  return text;
}

std::string text_of(const Vec3d& v) { return "[" + show(v.x) + ", " + show(v.y) + ", " + show(v.z) + "]"; }

// "> 0.0 and <= 1.2"; empty where single precision alone is the limit.
std::string limits_text(const Range& range) {
  std::string text;
  if (range.lower > -Range::largest)
    text += (range.lower_bound == Bound::open ? "> " : ">= ") + show(range.lower);
  if (range.upper < Range::largest)
    text += std::string(text.empty() ? "" : " and ") + (range.upper_bound == Bound::open ? "< " : "<= ") +
            show(range.upper);
  return text;
}

bool shares_words(const Where& a, const Where& b) {
  if (a.what != b.what) return false;
  if (a.words.empty()) return true;
  return std::any_of(a.words.begin(), a.words.end(), [&](const std::string& word) {
    return std::find(b.words.begin(), b.words.end(), word) != b.words.end();
  });
}

// Whether both may be asked for in one table.
bool meet(const CatalogueKey& a, const CatalogueKey& b) {
  for (std::size_t k = 0; k < a.where.size() && k < b.where.size(); ++k)
    if (!shares_words(a.where[k], b.where[k])) return false;
  return true;
}

bool same_facts(const CatalogueKey& a, const CatalogueKey& b) {
  return a.form == b.form && a.meaning == b.meaning && a.need == b.need && a.fallback == b.fallback &&
         a.unit == b.unit && a.allowed == b.allowed && a.where.size() == b.where.size() && !a.where.empty() &&
         a.where[0].what == b.where[0].what;
}

}  // namespace

std::string within(const std::string& table, const std::string& name) {
  return table.empty() ? name : table + "." + name;
}

std::string Where::text() const { return words.empty() ? what : what + " = " + quoted_list(words, " or "); }

std::string CatalogueKey::path() const { return within(table, name); }

std::string CatalogueKey::where_text() const {
  std::string text;
  for (const Where& condition : where) text += (text.empty() ? "" : ", ") + condition.text();
  return text;
}

std::string CatalogueKey::type_text() const {
  switch (form) {
    case Form::number:
      return "number";
    case Form::vector:
      return "[x, y, z]";
    case Form::integer:
      return "whole number";
    case Form::flag:
      return "true or false";
    case Form::text:
      return "text";
    case Form::numbers:
      return "list of numbers";
    case Form::vectors:
      return "list of [x, y, z]";
    case Form::pairs:
      return "list of [a, b]";
    case Form::choices:
      return "list of words";
    case Form::number_or_rows:
      return "number or rows";
    case Form::choice:
      return "word";
    case Form::choice_or_number:
      return "word or number";
    case Form::table:
      return "table";
    case Form::list:
      return "list of tables";
    default:
      return "tables by name";
  }
}

std::vector<const CatalogueKey*> Catalogue::in(const std::string& table) const {
  std::vector<const CatalogueKey*> found;
  for (const CatalogueKey& k : keys_)
    if (k.table == table) found.push_back(&k);
  return found;
}

const CatalogueKey* Catalogue::find(const std::string& table, const std::string& name) const {
  const auto found = std::find_if(keys_.begin(), keys_.end(),
                                  [&](const CatalogueKey& k) { return k.table == table && k.name == name; });
  return found == keys_.end() ? nullptr : &*found;
}

const Catalogue& catalogue() {
  static const Catalogue made = [] {
    CaseCataloguer collect;
    Case c;
    describe(collect, c);
    return Catalogue(collect.take());
  }();
  return made;
}

CatalogueKey CaseCataloguer::entry(Form form, const Key& k, const std::string& fallback) const {
  CatalogueKey found;
  found.form = form;
  found.table = tables_.back();
  found.name = k.name;
  found.meaning = k.meaning;
  found.need = k.need;
  found.word = k.word;
  found.in_words = !k.fallback.empty();
  if (k.need == Need::optional) found.fallback = k.fallback.empty() ? fallback : k.fallback;
  for (const auto& [where, reason] : conditions_) {
    found.where.push_back(where);
    if (!reason.empty()) found.reason = reason, found.reason_of = found.where.size() - 1;
  }
  return found;
}

// The same key of several kinds of entries becomes one.
void CaseCataloguer::add(CatalogueKey found) {
  for (CatalogueKey& other : keys_) {
    if (other.table != found.table || other.name != found.name) continue;
    if (meet(other, found)) throw Error("the key '" + found.path() + "' is declared twice");
    if (!same_facts(other, found)) continue;
    other.where[0].words.insert(other.where[0].words.end(), found.where[0].words.begin(),
                                found.where[0].words.end());
    return;
  }
  keys_.push_back(std::move(found));
}

bool CaseCataloguer::number(const Key& k, double& target, const Range& range) {
  const bool word = *k.word && target == k.word_value;
  CatalogueKey found = entry(Form::number, k, word ? '"' + std::string(k.word) + '"' : show(target));
  found.unit = range.unit;
  found.range = range;
  found.allowed = limits_text(range);
  if (*k.word) found.allowed += (found.allowed.empty() ? "\"" : ", or \"") + std::string(k.word) + "\"";
  add(std::move(found));
  return false;
}

bool CaseCataloguer::vector(const Key& k, Vec3d& target, const Range& range) {
  CatalogueKey found = entry(Form::vector, k, text_of(target));
  found.unit = range.unit;
  found.range = range;
  found.allowed = limits_text(range);
  add(std::move(found));
  return false;
}

bool CaseCataloguer::integer(const Key& k, int& target, Integers range) {
  CatalogueKey found = entry(Form::integer, k, std::to_string(target));
  found.allowed = std::to_string(range.lower) + " to " + std::to_string(range.upper);
  found.range = between(range.lower, range.upper, "");
  add(std::move(found));
  return false;
}

bool CaseCataloguer::flag(const Key& k, bool& target) {
  add(entry(Form::flag, k, target ? "true" : "false"));
  return false;
}

bool CaseCataloguer::text(const Key& k, std::string& target) {
  add(entry(Form::text, k, '"' + target + '"'));
  return false;
}

bool CaseCataloguer::numbers(const Key& k, std::vector<double>&, const std::string& allowed) {
  CatalogueKey found = entry(Form::numbers, k, "[]");
  found.allowed = allowed;
  add(std::move(found));
  return false;
}

bool CaseCataloguer::vectors(const Key& k, std::vector<Vec3d>&, const std::string& allowed) {
  CatalogueKey found = entry(Form::vectors, k, "[]");
  found.allowed = allowed;
  add(std::move(found));
  return false;
}

bool CaseCataloguer::pairs(const Key& k, Rows&, const std::string& allowed) {
  CatalogueKey found = entry(Form::pairs, k, "[]");
  found.allowed = allowed;
  add(std::move(found));
  return false;
}

bool CaseCataloguer::choices(const Key& k, bool*, const Words& words, const char*) {
  CatalogueKey found = entry(Form::choices, k, "[]");
  found.words = words;
  found.allowed = "of " + quoted_list(words, ", ");
  add(std::move(found));
  return false;
}

bool CaseCataloguer::number_or_rows(const Key& k, double& target, const Range& range, Rows&,
                                    const std::string& allowed) {
  CatalogueKey found = entry(Form::number_or_rows, k, show(target));
  found.unit = range.unit;
  found.range = range;
  found.allowed = limits_text(range) + ", or " + allowed;
  add(std::move(found));
  return false;
}

bool CaseCataloguer::choice(const Key& k, int& index, const Words& words) {
  CatalogueKey found = entry(Form::choice, k, '"' + words[static_cast<std::size_t>(index)] + '"');
  found.words = words;
  found.allowed = quoted_list(words, ", ");
  add(std::move(found));
  return true;
}

bool CaseCataloguer::reference(const Key& k, int&, const Words&, const char* one) {
  CatalogueKey found = entry(Form::text, k, "");
  found.allowed = std::string("name of ") + one;
  add(std::move(found));
  return false;
}

bool CaseCataloguer::choice_or_number(const Key& k, int& index, const Words& words, double&,
                                      const Range& range) {
  CatalogueKey found = entry(Form::choice_or_number, k, '"' + words[static_cast<std::size_t>(index)] + '"');
  found.words = words;
  found.unit = range.unit;
  found.range = range;
  found.allowed = quoted_list(words, ", ") + ", or a number " + limits_text(range);
  add(std::move(found));
  return false;
}

void CaseCataloguer::enter(Form form, const Key& k, const std::string& inside) {
  CatalogueKey found = entry(form, k, form == Form::table ? "" : "none");
  found.inside = inside;
  add(std::move(found));
  tables_.push_back(inside);
}

void CaseCataloguer::enter_table(const Key& k) { enter(Form::table, k, within(tables_.back(), k.name)); }

bool CaseCataloguer::enter_inline(const Key& k) {
  enter_table(k);
  return true;
}

std::size_t CaseCataloguer::enter_list(const Key& k, std::size_t, const char* of) {
  const std::string inside = *of ? of : within(tables_.back(), std::string(k.name) + ".N");
  const bool described = std::any_of(keys_.begin(), keys_.end(),
                                     [&](const CatalogueKey& other) { return other.table == inside; });
  enter(Form::list, k, inside);
  if (described) tables_.pop_back();
  return described ? 0 : 1;
}

std::size_t CaseCataloguer::enter_named(const Key& k, std::size_t) {
  enter(Form::named_list, k, within(tables_.back(), std::string(k.name) + ".NAME"));
  return 1;
}

void CaseCataloguer::leave() { tables_.pop_back(); }

bool CaseCataloguer::enter_only(bool, const Where& where, const std::string& reason) {
  conditions_.emplace_back(where, reason);
  return true;
}

void CaseCataloguer::leave_only() { conditions_.pop_back(); }

}  // namespace slagflow
