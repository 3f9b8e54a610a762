#include <gtest/gtest.h>

#include "host/text/number_text.hpp"

namespace slagflow {
namespace {

constexpr DecimalSign point = DecimalSign::point, comma = DecimalSign::comma;

TEST(NumberText, TellsTheDecimalSign) {
  for (const char* text : {"12", "-3", "+7", "1e3", "1 234", "1'234"})
    EXPECT_EQ(form_of(text), NumberForm::plain) << text;
  for (const char* text : {"1.5", "0.125", "1,234.5", "1,234,567", "1.234E+02", "1 234.567", ".5"})
    EXPECT_EQ(form_of(text), NumberForm::with_point) << text;
  for (const char* text : {"1,5", "0,125", "1.234,5", "1.234.567", "1,234e-2", "1234,567"})
    EXPECT_EQ(form_of(text), NumberForm::with_comma) << text;
  EXPECT_EQ(form_of("1.234"), NumberForm::unclear_point);
  EXPECT_EQ(form_of("12,345"), NumberForm::unclear_comma);
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "-", ".", "nan", "inf", "0x10", "1.2.3", "1,2,3", "12,34.5", "1 23", "1e",
                           "1e+", "5 Pa", "<0.1", "1,234.567.8", "--1", "1-2", "1e5e5", "12:30"})
    EXPECT_EQ(form_of(text), NumberForm::no_number) << text;
}

TEST(NumberText, GivesTheValue) {
  EXPECT_DOUBLE_EQ(number_of("1,234.5", point).value(), 1234.5);
  EXPECT_DOUBLE_EQ(number_of("1.234,5", comma).value(), 1234.5);
  EXPECT_DOUBLE_EQ(number_of("1\xE2\x80\xAF"
                             "234,5",
                             comma)
                       .value(),
                   1234.5);
  EXPECT_DOUBLE_EQ(number_of("1,234", point).value(), 1234);
  EXPECT_DOUBLE_EQ(number_of("1,234", comma).value(), 1.234);
  EXPECT_DOUBLE_EQ(number_of("\xE2\x88\x92"
                             "5e-1",
                             point)
                       .value(),
                   -0.5);
  EXPECT_FALSE(number_of("1,5", point).has_value());
  EXPECT_FALSE(number_of("1.5", comma).has_value());
  EXPECT_FALSE(number_of("1e400", point).has_value());
}

TEST(NumberText, SplitsANumberFromItsUnit) {
  EXPECT_EQ(split_number("5.5 Pa").number, "5.5");
  EXPECT_EQ(split_number("5.5 Pa").rest, "Pa");
  EXPECT_EQ(split_number("45%").rest, "%");
  EXPECT_EQ(split_number("Pa").number, "");
}

TEST(NumberText, InstrumentsSayThatThereIsNone) {
  for (const char* const text :
       {"---", "-", "NaN", "n/a", "Over range", "OVER-RANGE", "EEEE", "#NV", "#DIV/0!", "****", "-1.#IND",
        "\xC3\x9C"
        "berlauf",
        "\xE2\x80\x93"})
    EXPECT_TRUE(stands_for_no_number(text)) << text;
  for (const char* const text : {"", "0", "-1", "1.2*", "<0.1", "1e5", "E", "abc"})
    EXPECT_FALSE(stands_for_no_number(text)) << text;
}

}  // namespace
}  // namespace slagflow
