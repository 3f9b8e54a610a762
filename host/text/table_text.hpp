// Text of tables as instruments, spreadsheets and editors write it: encodings, line ends, separators, quotes.
#pragma once

#include <string>
#include <vector>

namespace slagflow {

struct DecodedText {
  std::string text;      // UTF-8 without a byte order mark, lines end with \n
  std::string encoding;  // what it was, for people
};

// From UTF-8 or UTF-16 with or without a byte order mark, or Windows-1252. Throws InputError, with `file`,
// where the bytes are no text: spreadsheets, archives, pictures.
DecodedText decode_text(const std::string& bytes, const std::string& file);

struct Record {
  int line = 0;                     // that it begins in, from 1
  std::vector<std::string> fields;  // without blanks and quotes around them

  // The fields that are not empty: of how many, and of how many up to the last one.
  std::size_t filled() const;
  std::size_t width() const;
};

// tab, semicolon, comma, bar: one such byte; blanks: two or more blanks or a tab; blank: one or more.
enum class Separator { tab, semicolon, comma, bar, blanks, blank };
const char* name_of(Separator separator);

struct Records {
  std::vector<Record> records;
  int open_quote = 0;  // line of a quote that is not closed; 0: none
};

// A field in quotes may hold separators, ends of lines and doubled quotes. Empty lines are records without a
// filled field.
Records split_records(const std::string& text, Separator separator);

// The same text where each line stands in quotes as a whole, without these.
std::string unwrap_lines(const std::string& text);

// Without blanks around it, among them those of UTF-8.
std::string trimmed(const std::string& text);

// Each `from` by its `to`, in that order.
struct Replacement {
  const char *from, *to;
};
std::string replaced(std::string text, const std::vector<Replacement>& replacements);

std::string quoted(const std::string& text);  // for messages; shortened where it is long

std::string lower_case(std::string text);  // of ASCII letters

}  // namespace slagflow
