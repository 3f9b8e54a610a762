// The reference of keys: what the declarations say, as a list.
#pragma once

#include <string>
#include <vector>

#include "host/case/case_visitor.hpp"

namespace slagflow {

enum class Form {
  number,
  vector,
  integer,
  flag,
  text,
  numbers,
  vectors,
  pairs,
  choices,
  number_or_rows,
  choice,
  choice_or_number,
  table,
  list,
  named_list
};

// A key, or a table of keys.
struct CatalogueKey {
  Form form = Form::number;
  std::string table;  // that it stands in: "", "numerics", "fluid.NAME", "wall.N.motion"; of shapes "shape"
  std::string name, meaning;
  Need need = Need::optional;
  std::string fallback;   // the default; empty: none
  bool in_words = false;  // the default is not a value
  std::string unit;
  std::string allowed;  // "> 0.0", "1.5 to 4.0"; empty: anything of the form
  Range range;
  Words words;                // of choices
  std::string word;           // in place of the number
  std::string inside;         // of a table: the name of the table of its keys
  std::vector<Where> where;   // all of them hold; empty: everywhere
  std::string reason;         // why it does not go elsewhere
  std::size_t reason_of = 0;  // the condition whose reason that is

  bool is_table() const { return form >= Form::table; }
  std::string path() const;        // fluid.NAME.yield_stress
  std::string where_text() const;  // rheology = "bingham" or "casson"
  std::string type_text() const;   // "number [Pa]", "one of", ...
};

class Catalogue {
 public:
  explicit Catalogue(std::vector<CatalogueKey> keys) : keys_(std::move(keys)) {}

  const std::vector<CatalogueKey>& keys() const { return keys_; }
  // Of one table, in the order of the declarations.
  std::vector<const CatalogueKey*> in(const std::string& table) const;
  const CatalogueKey* find(const std::string& table, const std::string& name) const;

 private:
  std::vector<CatalogueKey> keys_;
};

// Of the declarations of this program. Throws Error when one declares a key twice.
const Catalogue& catalogue();

// "table.name"
std::string within(const std::string& table, const std::string& name);

// Collects what declarations say.
class CaseCataloguer : public CaseVisitor {
 public:
  bool number(const Key&, double&, const Range&) override;
  bool vector(const Key&, Vec3d&, const Range&) override;
  bool integer(const Key&, int&, Integers) override;
  bool flag(const Key&, bool&) override;
  bool text(const Key&, std::string&) override;
  bool numbers(const Key&, std::vector<double>&, const std::string& allowed) override;
  bool vectors(const Key&, std::vector<Vec3d>&, const std::string& allowed) override;
  bool pairs(const Key&, Rows&, const std::string& allowed) override;
  bool choices(const Key&, bool* chosen, const Words&, const char* one) override;
  bool number_or_rows(const Key&, double&, const Range&, Rows&, const std::string& allowed) override;
  using CaseVisitor::choice;
  bool choice(const Key&, int& index, const Words&) override;
  bool reference(const Key&, int& index, const Words& names, const char* one) override;
  bool choice_or_number(const Key&, int& index, const Words&, double&, const Range&) override;

  std::vector<CatalogueKey> take() { return std::move(keys_); }

 protected:
  void enter_table(const Key&) override;
  bool enter_inline(const Key&) override;
  std::size_t enter_list(const Key&, std::size_t present, const char* of) override;
  void enter_entry(std::size_t) override {}
  std::size_t enter_named(const Key&, std::size_t present) override;
  void enter_named_entry(std::size_t, std::string& name) override { name = "NAME"; }
  void leave() override;
  void leave_list() override {}
  bool enter_only(bool holds, const Where&, const std::string& reason) override;
  void leave_only() override;

 private:
  CatalogueKey entry(Form form, const Key& k, const std::string& fallback) const;
  void add(CatalogueKey found);
  void enter(Form form, const Key& k, const std::string& inside);

  std::vector<CatalogueKey> keys_;
  std::vector<std::string> tables_{""};
  std::vector<std::pair<Where, std::string>> conditions_;  // and the reason
};

}  // namespace slagflow
