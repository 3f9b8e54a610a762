// Numbers as people and instruments write them: 1234.5, 1,234.5, 1.234,5, 1 234,5, 1'234.5, 1.2345E+03.
#pragma once

#include <optional>
#include <string>

namespace slagflow {

enum class DecimalSign { point, comma };

// What the text of a number says of the sign before its fraction: nothing, as 12; which one; unclear, one
// sign before three digits, as 1.234 or 1,234; or it is no number.
enum class NumberForm { no_number, plain, with_point, with_comma, unclear_point, unclear_comma };
NumberForm form_of(const std::string& text);

// Nothing where it is no number, or not one with that sign.
std::optional<double> number_of(const std::string& text, DecimalSign sign);

// Whether it is what instruments and spreadsheets write in place of a number that there is not: ---, NaN,
// n/a, over range, EEEE, #N/A.
bool stands_for_no_number(const std::string& text);

// The beginning of `5.5 Pa` that is a number, and what follows it.
struct NumberAndRest {
  std::string number, rest;
};
NumberAndRest split_number(const std::string& text);

}  // namespace slagflow
