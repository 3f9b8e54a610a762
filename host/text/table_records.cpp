// Splits text into records and fields.
#include <algorithm>
#include <sstream>

#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

class Splitter {
 public:
  Splitter(const std::string& text, Separator separator) : text_(text), separator_(separator) {}

  Records split() {
    while (at_ < text_.size()) {
      Record record{line_, {}};
      skip_blanks();
      while (!take_field(record)) continue;
      // Aligned columns begin and end with blanks: no fields of their own.
      if (blank_separated() && !record.fields.empty() && record.fields.back().empty())
        record.fields.pop_back();
      found_.records.push_back(std::move(record));
    }
    return std::move(found_);
  }

 private:
  bool blank_separated() const { return separator_ >= Separator::blanks; }
  char separator_byte() const { return "\t;,|"[static_cast<std::size_t>(separator_)]; }
  bool is_blank(std::size_t k) const {
    return k < text_.size() && (text_[k] == ' ' || (text_[k] == '\t' && separator_ != Separator::tab));
  }
  void skip_blanks() {
    while (is_blank(at_)) ++at_;
  }

  // Length of the separator at this place; 0: none is there.
  std::size_t separator_at(std::size_t k) const {
    if (!blank_separated()) return text_[k] == separator_byte() ? 1 : 0;
    std::size_t end = k;
    while (is_blank(end)) ++end;
    const bool enough = separator_ == Separator::blank || end - k >= 2 || (end > k && text_[k] == '\t');
    return enough ? end - k : 0;
  }

  // Returns true at the record's end.
  bool take_field(Record& record) {
    skip_blanks();
    std::string field;
    if (at_ < text_.size() && text_[at_] == '"') take_quoted(field);
    while (at_ < text_.size() && text_[at_] != '\n') {
      const std::size_t length = separator_at(at_);
      if (length > 0) {
        at_ += length;
        record.fields.push_back(trimmed(field));
        return false;
      }
      field.push_back(text_[at_++]);
    }
    record.fields.push_back(trimmed(field));
    ++at_, ++line_;
    return true;
  }

  void take_quoted(std::string& field) {
    const int begin = line_;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
          ++at_;
          return;
        }
        ++at_;
      }
      line_ += text_[at_] == '\n';
      field.push_back(text_[at_]);
    }
    if (found_.open_quote == 0) found_.open_quote = begin;
  }

  const std::string& text_;
  Separator separator_;
  std::size_t at_ = 0;
  int line_ = 1;
  Records found_;
};

}  // namespace

Records split_records(const std::string& text, Separator separator) {
  return Splitter(text, separator).split();
}

std::string unwrap_lines(const std::string& text) {
  std::stringstream lines(text);
  std::string unwrapped;
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    const bool whole = line.size() >= 2 && line.front() == '"' && line.back() == '"';
    unwrapped += (whole ? replaced(line.substr(1, line.size() - 2), {{"\"\"", "\""}}) : line) + "\n";
  }
  return unwrapped;
}

}  // namespace slagflow
