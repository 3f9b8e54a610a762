#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backend/error.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string in_utf16(const std::string& text, bool big) {
  std::string bytes;
  for (const char c : text) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

std::string refusal(const std::string& bytes) {
  try {
    decode_text(bytes, "x.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TableText, DecodesWhatEditorsWrite) {
  const std::string text = "a,b\n1,2\n";
  EXPECT_EQ(decode_text("\xEF\xBB\xBF" + text, "x").text, text);
  EXPECT_EQ(decode_text("\xFF\xFE" + in_utf16(text, false), "x").text, text);
  EXPECT_EQ(decode_text("\xFE\xFF" + in_utf16(text, true), "x").text, text);
  EXPECT_EQ(decode_text(in_utf16(text, false), "x").text, text);
  EXPECT_EQ(decode_text(in_utf16(text, true), "x").encoding, "UTF-16");
  EXPECT_EQ(decode_text("a,b\r\n1,2\r\n", "x").text, text);
  EXPECT_EQ(decode_text("a,b\r1,2\r", "x").text, text);
}

TEST(TableText, TakesBytesThatAreNoUtf8ForWindows1252) {
  const DecodedText decoded = decode_text(
      "\xB5Nm \xB0"
      "C \x96",
      "x");
  EXPECT_EQ(decoded.encoding, "Windows-1252");
  EXPECT_EQ(decoded.text,
            "\xC2\xB5Nm \xC2\xB0"
            "C \xE2\x80\x93");
  EXPECT_EQ(decode_text("\xC2\xB5Nm", "x").encoding, "UTF-8");
}

TEST(TableText, RefusesWhatIsNoText) {
  EXPECT_THAT(refusal("PK\x03\x04..."), HasSubstr("x.csv:1: the file is a spreadsheet"));
  EXPECT_THAT(refusal("%PDF-1.4"), HasSubstr("a PDF"));
  EXPECT_THAT(refusal(std::string("a\nb\0c", 5)), HasSubstr("x.csv:2: a byte of value 0"));
}

TEST(TableText, SplitsQuotedFields) {
  const Records split =
      split_records("a,\"b, c\",\"d \"\"e\"\"\"\n1, 2 ,\"x\ny\"\n3,5\" cup,\n", Separator::comma);
  ASSERT_EQ(split.records.size(), 3u);
  EXPECT_THAT(split.records[0].fields, ElementsAre("a", "b, c", "d \"e\""));
  EXPECT_THAT(split.records[1].fields, ElementsAre("1", "2", "x\ny"));
  EXPECT_THAT(split.records[2].fields, ElementsAre("3", "5\" cup", ""));
  EXPECT_EQ(split.records[2].line, 4);
  EXPECT_EQ(split.records[2].width(), 2u);
  EXPECT_EQ(split.open_quote, 0);
}

TEST(TableText, TellsAQuoteThatStaysOpen) {
  EXPECT_EQ(split_records("a,b\n1,\"2\n3,4\n", Separator::comma).open_quote, 2);
}

TEST(TableText, SplitsAtBlanks) {
  EXPECT_THAT(split_records("  shear rate   stress\n", Separator::blanks).records[0].fields,
              ElementsAre("shear rate", "stress"));
  EXPECT_THAT(split_records(" 1 2\t3 \n", Separator::blank).records[0].fields, ElementsAre("1", "2", "3"));
  EXPECT_THAT(split_records("1\t\t3\n", Separator::tab).records[0].fields, ElementsAre("1", "", "3"));
}

TEST(TableText, UnwrapsLinesInQuotes) {
  EXPECT_EQ(unwrap_lines("\"a,b\"\n\"1,\"\"2\"\"\"\n"), "a,b\n1,\"2\"\n");
}

}  // namespace
}  // namespace slagflow
