// The visitor that fills a case from a file. What is wrong is collected in CaseProblems.
#pragma once

#include <string>
#include <vector>

#include "host/case/case_visitor.hpp"

namespace slagflow {

struct CatalogueKey;

class CaseReader : public CaseVisitor {
 public:
  CaseReader(const Toml& root, const Place& place, CaseProblems& problems);

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

  bool given(std::initializer_list<const char*> keys) const override;
  bool is_table(const char* name) const override { return frames_.back().table.is_table(name); }
  bool given_by_set(const char* name) const override { return frames_.back().table.set(name); }
  void problem(const std::string& name, const std::string& what) override;
  // Reports the keys of the file's top level that are not known. Once, at the end.
  void finish();

 protected:
  void enter_table(const Key&) override;
  bool enter_inline(const Key&) override;
  std::size_t enter_list(const Key&, std::size_t present, const char* of) override;
  void enter_entry(std::size_t index) override;
  std::size_t enter_named(const Key&, std::size_t present) override;
  void enter_named_entry(std::size_t index, std::string& name) override;
  void leave() override;
  void leave_list() override;

 private:
  struct Frame {
    CaseTable table;
    std::string described;                 // the table's name in the reference of keys
    std::vector<std::string> undecided{};  // choices that are not known
    std::string meant{};  // of a table that only an override names: an entry of the file with a like name
  };
  struct List {
    std::vector<std::pair<std::string, CaseTable>> entries;
    std::string described;  // of each of them
  };

  CaseTable& here() { return frames_.back().table; }
  void enter(CaseTable table, const std::string& described);
  void report_unknown(Frame& frame);
  static bool undecided(const Frame& frame, const CatalogueKey& k);
  static bool kept_out_by_word(Frame& frame, const CatalogueKey& k);
  static Words allowed_in(const Frame& frame);

  std::vector<Frame> frames_;
  std::vector<List> lists_;
};

}  // namespace slagflow
