// A case as a TOML file with every key.
#include <cstdio>

#include "host/case/case_keys.hpp"

namespace slagflow {
namespace {

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < ' ' || c == 127) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04X", static_cast<unsigned>(c));
      result += escaped;
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string text_of(double value) { return show(value); }
std::string text_of(const std::array<double, 2>& row) {
  return "[" + show(row[0]) + ", " + show(row[1]) + "]";
}
std::string text_of(const Vec3d& v) { return "[" + show(v.x) + ", " + show(v.y) + ", " + show(v.z) + "]"; }

template <class T>
std::string text_of(const std::vector<T>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "[" : ", ") + text_of(value);
  return text + "]";
}

class CaseWriter : public CaseVisitor {
 public:
  std::string take() { return std::move(out_); }

  bool number(const Key& k, double& value, const Range& range) override {
    return assign(k, *k.word && !range.holds(value) ? toml_string(k.word) : show(value));
  }
  bool vector(const Key& k, Vec3d& value, const Range&) override { return assign(k, text_of(value)); }
  bool integer(const Key& k, int& value, Integers) override { return assign(k, std::to_string(value)); }
  bool flag(const Key& k, bool& value) override { return assign(k, value ? "true" : "false"); }
  bool text(const Key& k, std::string& value) override { return assign(k, toml_string(value)); }
  bool numbers(const Key& k, std::vector<double>& values, const std::string&) override {
    return !values.empty() && assign(k, text_of(values));
  }
  bool vectors(const Key& k, std::vector<Vec3d>& values, const std::string&) override {
    return !values.empty() && assign(k, text_of(values));
  }
  bool pairs(const Key& k, Rows& value, const std::string&) override { return assign(k, text_of(value)); }
  bool choices(const Key& k, bool* chosen, const Words& words, const char*) override {
    std::string list;
    for (std::size_t w = 0; w < words.size(); ++w)
      if (chosen[w]) list += (list.empty() ? "" : ", ") + toml_string(words[w]);
    return assign(k, "[" + list + "]");
  }
  bool number_or_rows(const Key& k, double& value, const Range& range, Rows& rows,
                      const std::string&) override {
    return rows.empty() ? number(k, value, range) : assign(k, text_of(rows));
  }
  using CaseVisitor::choice;
  bool choice(const Key& k, int& index, const Words& words) override {
    assign(k, toml_string(words[static_cast<std::size_t>(index)]));
    return true;
  }
  bool reference(const Key& k, int& index, const Words& names, const char*) override {
    return assign(k, toml_string(names[static_cast<std::size_t>(index)]));
  }
  bool choice_or_number(const Key& k, int& index, const Words& words, double& value, const Range&) override {
    const auto word = static_cast<std::size_t>(index);
    return assign(k, word < words.size() ? toml_string(words[word]) : show(value));
  }
  bool takes_defaults() const override { return false; }

 protected:
  void enter_table(const Key& k) override { out_ += "\n[" + std::string(k.name) + "]\n"; }
  bool enter_inline(const Key& k) override {
    begin(k.name);
    out_ += '{';
    inline_.push_back(true);
    return true;
  }
  // Lists of the top level are [[tables]], those inside of tables are {tables}.
  std::size_t enter_list(const Key& k, std::size_t present, const char*) override {
    lists_.push_back({k.name, in_table_});
    if (!in_table_) return present;
    begin(k.name);
    out_ += '[';
    return present;
  }
  void enter_entry(std::size_t) override {
    if (!lists_.back().inside) {
      out_ += "\n[[" + lists_.back().name + "]]\n";
      in_table_ = true;
      return;
    }
    out_ += "\n  {";
    inline_.push_back(true);
  }
  std::size_t enter_named(const Key& k, std::size_t present) override {
    lists_.push_back({k.name, false});
    return present;
  }
  void enter_named_entry(std::size_t, std::string& name) override {
    out_ += "\n[" + lists_.back().name + "." + name + "]\n";
  }
  void leave() override {
    if (inline_.empty()) {
      in_table_ = false;
      return;
    }
    inline_.pop_back();
    out_ += inline_.empty() && !lists_.empty() && lists_.back().inside ? "}," : "}";
    if (inline_.empty() && !(!lists_.empty() && lists_.back().inside)) out_ += '\n';
  }
  void leave_list() override {
    const List list = lists_.back();
    lists_.pop_back();
    if (list.inside) out_ += out_.back() == '[' ? "]\n" : "\n]\n";
  }

 private:
  struct List {
    std::string name;
    bool inside;  // of a table
  };

  // In a line of its own, or after a comma.
  void begin(const std::string& name) {
    if (!inline_.empty()) {
      if (!inline_.back()) out_ += ", ";
      inline_.back() = false;
    }
    out_ += name + " = ";
  }
  bool assign(const Key& k, const std::string& value) {
    if (!k.written) return false;
    begin(k.name);
    out_ += value;
    if (inline_.empty()) out_ += '\n';
    return false;
  }

  std::string out_;
  std::vector<bool> inline_;  // open {tables}; whether nothing is in it yet
  std::vector<List> lists_;
  bool in_table_ = false;
};

}  // namespace

std::string to_toml(const Case& c) {
  CaseWriter writer;
  Case written = c;
  describe(writer, written);
  return "# The resolved case: every key with its value, defaults included.\n" + writer.take();
}

}  // namespace slagflow
