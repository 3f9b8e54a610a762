// How the keys of a case are declared: each once, in a function describe(CaseVisitor&, ...) of its table. The
// reader, the writer of resolved cases and the reference of keys are visitors of these functions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fluid/math.hpp"
#include "host/case/case_table.hpp"

namespace slagflow {

// What is said of a key beside its type. Texts are for the reference of keys: plain words, UTF-8.
struct Key {
  const char* name;
  std::string meaning;
  Need need = Need::optional;
  std::string fallback{};  // the default in words; empty: the value that the member has before it is read
  const char* word = "";   // may stand in place of the number, for word_value
  double word_value = 0;
  bool written = true;  // in a resolved case

  Key by_default(std::string text) && { return fallback = std::move(text), std::move(*this); }
  Key or_word(const char* text, double value) && { return word = text, word_value = value, std::move(*this); }
  // Stands for other keys, which are written instead.
  Key shorthand() && { return written = false, std::move(*this); }
};
inline Key key(const char* name, std::string meaning) { return {name, std::move(meaning)}; }
inline Key required(const char* name, std::string meaning) {
  return {name, std::move(meaning), Need::required};
}

using Words = std::vector<std::string>;
struct Integers {
  int lower, upper;
};

// Where keys belong: beside another key of their table that says one of these words, or beside a kind of
// entry.
struct Where {
  std::string what;  // a key, or in words
  Words words{};     // of the key

  std::string text() const;  // type = "front" or "jet"
};

class CaseVisitor {
 public:
  virtual ~CaseVisitor() = default;

  // A value each. True when the file gives it, and rightly.
  virtual bool number(const Key&, double&, const Range&) = 0;
  virtual bool vector(const Key&, Vec3d&, const Range&) = 0;
  virtual bool integer(const Key&, int&, Integers) = 0;
  virtual bool flag(const Key&, bool&) = 0;
  virtual bool text(const Key&, std::string&) = 0;
  virtual bool numbers(const Key&, std::vector<double>&, const std::string& allowed) = 0;
  virtual bool vectors(const Key&, std::vector<Vec3d>&, const std::string& allowed) = 0;
  // Rows of two numbers.
  using Rows = std::vector<std::array<double, 2>>;
  virtual bool pairs(const Key&, Rows&, const std::string& allowed) = 0;
  // Any of the words, each at most once.
  virtual bool choices(const Key&, bool* chosen, const Words&, const char* one) = 0;
  // A number, or rows of two of them.
  virtual bool number_or_rows(const Key&, double&, const Range&, Rows&, const std::string& allowed) = 0;

  // Words. False when what the key says is not known, since it is faulty or missing and required.
  virtual bool choice(const Key&, int& index, const Words&) = 0;
  // The name of another entry of the case.
  virtual bool reference(const Key&, int& index, const Words& names, const char* one) = 0;
  // A word, or a number, for which the index is one beyond the words.
  virtual bool choice_or_number(const Key&, int& index, const Words&, double&, const Range&) = 0;
  template <class E>
  bool choice(const Key& k, E& target, const Words& words) {
    int index = static_cast<int>(target);
    const bool known = choice(k, index, words);
    target = static_cast<E>(index);
    return known;
  }

  // [key], there or not.
  template <class F>
  void table(const Key& k, F inside) {
    enter_table(k);
    inside();
    leave();
  }
  // key = {...}, when it is there.
  template <class F>
  void inline_table(const Key& k, F inside) {
    if (!enter_inline(k)) return;
    inside();
    leave();
  }
  // [[key]], or key = [{...}, ...]. Lists that are described by the same function share the name `of`.
  template <class T, class F>
  void list(const Key& k, std::vector<T>& entries, F describe_entry, const char* of = "") {
    const std::size_t count = enter_list(k, entries.size(), of);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == entries.size()) entries.emplace_back();
      enter_entry(i);
      describe_entry(entries[i]);
      leave();
    }
    leave_list();
  }
  // [key.NAME]
  template <class T, class F>
  void named_list(const Key& k, std::vector<T>& entries, F describe_entry) {
    const std::size_t count = enter_named(k, entries.size());
    for (std::size_t i = 0; i < count; ++i) {
      if (i == entries.size()) entries.emplace_back();
      enter_named_entry(i, entries[i].name);
      describe_entry(entries[i]);
      leave();
    }
    leave_list();
  }

  // if (const auto with = v.only(type == jet, {"type", {"jet"}})) ...: keys that belong to an entry only
  // where `holds`. Elsewhere they are refused, for the reason, or unknown.
  class Only;
  Only only(bool holds, const Where& where, const std::string& reason = "");

  // Whether any of the keys is given, be it right or wrong.
  virtual bool given(std::initializer_list<const char*>) const { return false; }
  // Whether the key is given, and holds a table.
  virtual bool is_table(const char* /*key*/) const { return false; }
  // Whether the command line gives it, which goes before the file.
  virtual bool given_by_set(const char* /*key*/) const { return false; }
  // Whether members without a key take their defaults: so it is unless a case is written.
  virtual bool takes_defaults() const { return true; }
  virtual void problem(const std::string& /*key*/, const std::string& /*what*/) {}

 protected:
  virtual void enter_table(const Key&) = 0;
  virtual bool enter_inline(const Key&) = 0;
  virtual std::size_t enter_list(const Key&, std::size_t present, const char* of) = 0;
  virtual void enter_entry(std::size_t index) = 0;
  virtual std::size_t enter_named(const Key&, std::size_t present) = 0;
  virtual void enter_named_entry(std::size_t index, std::string& name) = 0;
  virtual void leave() = 0;  // a table or an entry
  virtual void leave_list() = 0;
  virtual bool enter_only(bool holds, const Where&, const std::string& /*reason*/) { return holds; }
  virtual void leave_only() {}
};

class CaseVisitor::Only {
 public:
  Only(CaseVisitor& visitor, bool described) : visitor_(visitor), described_(described) {}
  ~Only() { visitor_.leave_only(); }
  Only(const Only&) = delete;
  Only& operator=(const Only&) = delete;
  explicit operator bool() const { return described_; }

 private:
  CaseVisitor& visitor_;
  bool described_;
};

inline CaseVisitor::Only CaseVisitor::only(bool holds, const Where& where, const std::string& reason) {
  return {*this, enter_only(holds, where, reason)};
}

}  // namespace slagflow
