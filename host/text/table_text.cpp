#include "host/text/table_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "backend/error.hpp"

namespace slagflow {
namespace {

constexpr std::uint32_t no_character = 0xFFFD;

bool begins_with(const std::string& text, const std::string& head) {
  return text.compare(0, head.size(), head) == 0;
}

void append_utf8(std::string& text, std::uint32_t c) {
  const auto byte = [&](std::uint32_t value) { text.push_back(static_cast<char>(value)); };
  if (c < 0x80) {
    byte(c);
  } else if (c < 0x800) {
    byte(0xC0 | c >> 6), byte(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    byte(0xE0 | c >> 12), byte(0x80 | (c >> 6 & 0x3F)), byte(0x80 | (c & 0x3F));
  } else {
    byte(0xF0 | c >> 18), byte(0x80 | (c >> 12 & 0x3F)), byte(0x80 | (c >> 6 & 0x3F)),
        byte(0x80 | (c & 0x3F));
  }
}

std::uint32_t byte_at(const std::string& bytes, std::size_t k) {
  return static_cast<unsigned char>(bytes[k]);
}

std::string from_utf16(const std::string& bytes, std::size_t start, bool big) {
  std::string text;
  std::uint32_t high = 0;
  for (std::size_t k = start; k + 1 < bytes.size(); k += 2) {
    const std::uint32_t unit = byte_at(bytes, k + (big ? 0 : 1)) << 8 | byte_at(bytes, k + (big ? 1 : 0));
    const bool leads = unit >= 0xD800 && unit < 0xDC00, follows = unit >= 0xDC00 && unit < 0xE000;
    if (high && follows)
      append_utf8(text, 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00));
    else if (!leads)
      append_utf8(text, follows ? no_character : unit);
    high = leads ? unit : 0;
  }
  return text;
}

// The 32 characters that Windows-1252 has in place of Latin-1's control characters.
constexpr std::array<std::uint16_t, 32> windows_characters{
    0x20AC, 0x81,   0x201A, 0x192,  0x201E, 0x2026, 0x2020, 0x2021, 0x2C6,  0x2030, 0x160,
    0x2039, 0x152,  0x8D,   0x17D,  0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x2DC,  0x2122, 0x161,  0x203A, 0x153,  0x9D,   0x17E,  0x178};

std::string from_windows(const std::string& bytes) {
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const std::uint32_t c = byte_at(bytes, k);
    append_utf8(text, c >= 0x80 && c < 0xA0 ? windows_characters[c - 0x80] : c);
  }
  return text;
}

// Bytes that follow the first one of a character; -1 where none begins so.
int followers(std::uint32_t first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

bool is_utf8(const std::string& bytes) {
  for (std::size_t k = 0; k < bytes.size(); ++k)
    for (int more = followers(byte_at(bytes, k)); more != 0; --more)
      if (more < 0 || ++k >= bytes.size() || byte_at(bytes, k) >> 6 != 2) return false;
  return true;
}

// Half of all bytes are 0, at even (big) or odd places: UTF-16 without its mark.
bool is_bare_utf16(const std::string& bytes, bool big) {
  if (bytes.size() < 4 || bytes.size() % 2) return false;
  std::array<std::size_t, 2> zeros{};
  for (std::size_t k = 0; k < bytes.size(); ++k) zeros[k % 2] += bytes[k] == '\0';
  return zeros[big ? 0 : 1] > bytes.size() / 4 && zeros[big ? 1 : 0] == 0;
}

void refuse_other_kinds(const std::string& bytes, const std::string& file) {
  struct Kind {
    std::string head;
    const char* name;
  };
  static const std::vector<Kind> kinds{{"PK\x03\x04", "a spreadsheet (.xlsx, .ods) or a zip archive"},
                                       {"\xD0\xCF\x11\xE0", "a spreadsheet (.xls)"},
                                       {"%PDF", "a PDF"},
                                       {"\x1F\x8B", "a gzip archive"},
                                       {"\x89PNG", "a picture"},
                                       {"\x89HDF", "an HDF5 file"},
                                       {{"\xFF\xFE\0\0", 4}, "UTF-32"}};
  for (const Kind& kind : kinds)
    if (begins_with(bytes, kind.head))
      throw InputError(file + ":1: the file is " + kind.name + ": allowed: text, as CSV; export it so");
}

std::string with_plain_line_ends(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n') continue;
    plain.push_back(text[k] == '\r' ? '\n' : text[k]);
  }
  return plain;
}

int line_at(const std::string& text, std::size_t place) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(place);
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

}  // namespace

DecodedText decode_text(const std::string& bytes, const std::string& file) {
  refuse_other_kinds(bytes, file);
  DecodedText decoded;
  if (begins_with(bytes, "\xEF\xBB\xBF"))
    decoded = {bytes.substr(3), "UTF-8"};
  else if (begins_with(bytes, "\xFF\xFE") || begins_with(bytes, "\xFE\xFF"))
    decoded = {from_utf16(bytes, 2, bytes[0] == '\xFE'), "UTF-16"};
  else if (is_bare_utf16(bytes, false) || is_bare_utf16(bytes, true))
    decoded = {from_utf16(bytes, 0, is_bare_utf16(bytes, true)), "UTF-16"};
  else if (is_utf8(bytes))
    decoded = {bytes, "UTF-8"};
  else
    decoded = {from_windows(bytes), "Windows-1252"};
  decoded.text = with_plain_line_ends(decoded.text);
  const std::size_t zero = decoded.text.find('\0');
  if (zero != std::string::npos)
    throw InputError(file + ":" + std::to_string(line_at(decoded.text, zero)) +
                     ": a byte of value 0: allowed: text, as UTF-8, UTF-16 or Windows-1252");
  return decoded;
}

std::size_t Record::filled() const {
  return fields.size() - static_cast<std::size_t>(std::count(fields.begin(), fields.end(), ""));
}

std::size_t Record::width() const {
  std::size_t width = fields.size();
  while (width > 0 && fields[width - 1].empty()) --width;
  return width;
}

const char* name_of(Separator separator) {
  constexpr std::array<const char*, 6> names{"tabs", "semicolons", "commas", "bars", "blanks", "blanks"};
  return names[static_cast<std::size_t>(separator)];
}

std::string replaced(std::string text, const std::vector<Replacement>& replacements) {
  for (const Replacement& r : replacements) {
    const std::string from = r.from, to = r.to;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return text;
}

std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;
  return "\"" + (text.size() > longest ? text.substr(0, longest) + "..." : text) + "\"";
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string trimmed(const std::string& text) {
  static const std::vector<std::string> blanks{" ",        "\t",           "\n",          "\r",
                                               "\xC2\xA0", "\xE2\x80\xAF", "\xEF\xBB\xBF"};
  std::size_t first = 0, last = text.size();
  const auto shrink = [&](bool front) {
    for (const std::string& blank : blanks) {
      if (last - first < blank.size()) continue;
      const std::size_t at = front ? first : last - blank.size();
      if (text.compare(at, blank.size(), blank) != 0) continue;
      front ? first += blank.size() : last -= blank.size();
      return true;
    }
    return false;
  };
  while (shrink(true)) continue;
  while (shrink(false)) continue;
  return text.substr(first, last - first);
}

}  // namespace slagflow
