#include "host/text/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Parts {
  bool good = false, grouped_by_blanks = false;
  std::string sign, body, exponent;  // body: digits, points and commas
};

// One to three digits, then groups of `mark` and three digits.
bool is_grouped(const std::string& digits, char mark) {
  std::size_t at = std::min(digits.find(mark), digits.size());
  if (at < 1 || at > 3 || (digits[0] == '0')) return false;
  for (; at < digits.size(); at += 4)
    if (digits[at] != mark || at + 4 > digits.size() ||
        !std::all_of(digits.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                     digits.begin() + static_cast<std::ptrdiff_t>(at) + 4, is_digit))
      return false;
  return true;
}

std::string plain_signs(const std::string& text) {
  return replaced(trimmed(text), {{"\xE2\x88\x92", "-"},  // minus
                                  {"\xE2\x80\x93", "-"},  // dash
                                  {"\xC2\xA0", " "},      // blanks that do not break
                                  {"\xE2\x80\xAF", " "},
                                  {"\xE2\x80\x89", " "},
                                  {"\xE2\x80\x99", " "},  // apostrophes between thousands
                                  {"'", " "}});
}

Parts parts_of(const std::string& original) {
  Parts parts;
  std::string text = plain_signs(original);
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
    parts.sign = text.substr(0, 1);
    text.erase(0, 1);
  }
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string::npos) {
    parts.exponent = text.substr(e);
    text.erase(e);
    const std::size_t digits = parts.exponent.find_first_not_of("eE+-");
    if (digits == std::string::npos || digits > 2 || parts.exponent.size() - digits > 3 ||
        (digits == 2 && is_digit(parts.exponent[1])) ||
        parts.exponent.find_first_of("eE", 1) != std::string::npos)
      return parts;
    if (!std::all_of(parts.exponent.begin() + static_cast<std::ptrdiff_t>(digits), parts.exponent.end(),
                     is_digit))
      return parts;
  }
  const std::string whole = text.substr(0, text.find_first_of(".,"));
  if (whole.find(' ') != std::string::npos) {
    if (!is_grouped(whole, ' ')) return parts;
    parts.grouped_by_blanks = true;
    text = replaced(whole, {{" ", ""}}) + text.substr(whole.size());
  }
  parts.body = text;
  const auto digits = std::count_if(text.begin(), text.end(), is_digit);
  parts.good = digits > 0 && text.find_first_not_of("0123456789.,") == std::string::npos;
  return parts;
}

// `sign` stands once, after all `other`, which stand between groups of three.
bool is_fraction_sign(const std::string& body, char sign, char other) {
  const std::size_t at = body.find(sign);
  return std::count(body.begin(), body.end(), sign) == 1 && is_grouped(body.substr(0, at), other) &&
         body.find(other, at) == std::string::npos;
}

// What instruments and spreadsheets write where there is no number, in lower case.
constexpr std::array<const char*, 62> words_for_none{
    "nan",       "-nan",          "nan(ind)",  "-nan(ind)",   "1.#qnan",    "1.#ind",        "-1.#ind",
    "1.#inf",    "-1.#inf",       "1,#qnan",   "-1,#ind",     "1,#inf",     "n/a",           "na",
    "n.a.",      "n. a.",         "#n/a",      "#na",         "#nan",       "#nv",           "#div/0!",
    "#value!",   "#wert!",        "#num!",     "#zahl!",      "#ref!",      "#bezug!",       "null",
    "none",      "void",          "inf",       "-inf",        "+inf",       "infinity",      "-infinity",
    "over",      "over range",    "overrange", "overflow",    "overload",   "out of range",  "ol",
    "o.l.",      "ovl",           "under",     "under range", "underrange", "underflow",     "underload",
    "err",       "error",         "fail",      "failed",      "invalid",    "\u00fcberlauf", "\u00fcberlast",
    "unterlauf", "ung\u00fcltig", "fehler",    "erreur",      "hors plage", "hors gamme"};

}  // namespace

NumberForm form_of(const std::string& text) {
  const Parts parts = parts_of(text);
  if (!parts.good) return NumberForm::no_number;
  const auto points = std::count(parts.body.begin(), parts.body.end(), '.');
  const auto commas = std::count(parts.body.begin(), parts.body.end(), ',');
  if (points == 0 && commas == 0) return NumberForm::plain;
  if (points > 0 && commas > 0) {
    if (parts.grouped_by_blanks) return NumberForm::no_number;
    if (is_fraction_sign(parts.body, '.', ',')) return NumberForm::with_point;
    return is_fraction_sign(parts.body, ',', '.') ? NumberForm::with_comma : NumberForm::no_number;
  }
  const char mark = points > 0 ? '.' : ',';
  const bool grouped = is_grouped(parts.body, mark) && parts.exponent.empty() && !parts.grouped_by_blanks;
  if (points + commas > 1) {
    if (!grouped) return NumberForm::no_number;
    return mark == '.' ? NumberForm::with_comma : NumberForm::with_point;
  }
  if (grouped) return mark == '.' ? NumberForm::unclear_point : NumberForm::unclear_comma;
  return mark == '.' ? NumberForm::with_point : NumberForm::with_comma;
}

std::optional<double> number_of(const std::string& text, DecimalSign sign) {
  const NumberForm form = form_of(text);
  const bool comma = sign == DecimalSign::comma;
  if (form == NumberForm::no_number || form == (comma ? NumberForm::with_point : NumberForm::with_comma))
    return {};
  const Parts parts = parts_of(text);
  const std::string body =
      comma ? replaced(parts.body, {{".", ""}, {",", "."}}) : replaced(parts.body, {{",", ""}});
  const double value = std::strtod((parts.sign + body + parts.exponent).c_str(), nullptr);
  if (!std::isfinite(value)) return {};
  return value;
}

bool stands_for_no_number(const std::string& text) {
  const std::string plain =
      lower_case(replaced(trimmed(text), {{"\u2013", "-"}, {"\u2014", "-"}, {"\u00dc", "\u00fc"}}));
  if (plain.empty()) return false;
  const bool one_sign = plain.find_first_not_of(plain[0]) == std::string::npos;
  if (one_sign &&
      (std::string("-*#?.").find(plain[0]) != std::string::npos || (plain[0] == 'e' && plain.size() > 1)))
    return true;
  const std::string spaced = replaced(plain, {{"-", " "}, {"_", " "}});
  return std::any_of(words_for_none.begin(), words_for_none.end(),
                     [&](const char* word) { return plain == word || spaced == word; });
}

NumberAndRest split_number(const std::string& text) {
  constexpr std::size_t longest = 40;
  for (std::size_t end = std::min(text.size(), longest); end > 0; --end) {
    const std::string head = text.substr(0, end);
    if (form_of(head) != NumberForm::no_number) return {trimmed(head), trimmed(text.substr(end))};
  }
  return {"", text};
}

}  // namespace slagflow
