#include "host/rheometry/rheometry_facts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

#include "host/rheometry/rheometry_spindles.hpp"

namespace slagflow {
namespace {

std::optional<double>* place_of(Quantity q, SampleFacts& facts) {
  switch (q) {
    case Quantity::bob_radius:
      return &facts.bob_radius;
    case Quantity::cup_radius:
      return &facts.cup_radius;
    case Quantity::height:
      return &facts.height;
    case Quantity::full_scale_torque:
      return &facts.full_scale_torque;
    case Quantity::density:
      return &facts.density;
    default:
      return nullptr;
  }
}

// A decimal comma is one here too, where no digits follow that would make it one of thousands.
std::optional<double> value_of(const std::string& text) {
  const NumberForm form = form_of(text);
  if (form == NumberForm::unclear_comma) return {};
  return number_of(text, form == NumberForm::with_comma ? DecimalSign::comma : DecimalSign::point);
}

// The series of spindles that a line names as its viscometer's: "Brookfield LVT", "Modell DV2TRV".
const char* series_of(const std::string& line) {
  const std::string lower = lower_case(line);
  const auto says = [&](const char* word) { return lower.find(word) != std::string::npos; };
  if (!says("brookfield") && !says("visco") && !says("visko") && !says("model")) return "";
  std::string word;
  for (const char c : lower + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += c;
      continue;
    }
    for (const char* const series : {"lv", "rv"})
      if (word.rfind(series, 0) == 0 || (word.size() > 2 && word.compare(word.size() - 2, 2, series) == 0))
        return series;
    word.clear();
  }
  return "";
}

class FactsReader {
 public:
  explicit FactsReader(std::vector<Problem>& problems) : problems_(problems) {}

  void read_comment(const Record& record) {
    std::string text;
    for (const std::string& field : record.fields) text += (text.empty() ? "" : ",") + field;
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return;
    const std::string head = trimmed(text.substr(0, equals));
    const std::string key = trimmed(head.substr(std::min(head.find_first_not_of("#/ "), head.size())));
    line_ = record.line;
    take_key(key, trimmed(text.substr(equals + 1)));
  }

  // Lines of an export: only what is a fact beyond doubt.
  void read_line(const Record& record) {
    std::vector<std::string> words = record.fields;
    std::string all;
    for (const std::string& word : words) all += word + " ";
    if (const char* const series = series_of(all); *series) series_ = series;
    words.erase(std::remove(words.begin(), words.end(), ""), words.end());
    const std::size_t joint = words[0].find_first_of("=:");
    if (joint != std::string::npos) {
      const std::string rest = trimmed(words[0].substr(joint + 1));
      words[0] = trimmed(words[0].substr(0, joint));
      if (!rest.empty()) words.insert(words.begin() + 1, rest);
    }
    if (words.size() < 2) return;
    if (is_spindle(words[0])) take_spindle_of_line(words[1]);
    const NumberAndRest parts = split_number(words[1]);
    const std::string unit = words.size() > 2 ? words[2] : parts.rest;
    NamedQuantity named = parse_name(words[0]);
    if (named.known && !named.unit_known) named = with_unit(named, unit);
    std::optional<double>* const target =
        named.unit_known ? place_of(named.quantity, facts_.sample) : nullptr;
    const std::optional<double> value = value_of(parts.number);
    if (target && value && disbelief(*value, named).empty()) *target = *value * named.factor;
  }

  FileFacts facts() const {
    FileFacts facts = facts_;
    if (!facts.sample.spindle && !bare_spindle_.empty() && find_spindle(series_ + bare_spindle_))
      facts.sample.spindle = series_ + bare_spindle_;
    return facts;
  }

 private:
  void problem(const std::string& key, const std::string& what) {
    problems_.push_back({line_, "key '" + key + "'" + what});
  }

  static bool is_spindle(const std::string& word) {
    return lower_case(word) == "spindle" || lower_case(word) == "spindel";
  }

  // A number alone is one of the series that another line names.
  void take_spindle_of_line(const std::string& name) {
    if (find_spindle(name))
      facts_.sample.spindle = name;
    else
      bare_spindle_ = name;
  }

  void take_key(const std::string& key, const std::string& value) {
    if (key == "name")
      facts_.sample.name = value;
    else if (is_spindle(key))
      take_spindle(value);
    else if (key == "decimal")
      take_decimal(value);
    else
      take_quantity(key, value);
  }

  void take_spindle(const std::string& value) {
    facts_.sample.spindle = value;
    if (!find_spindle(value)) problem("spindle", ": value \"" + value + "\": allowed: " + allowed_spindles);
  }

  void take_decimal(const std::string& value) {
    if (value == "comma" || value == "point")
      facts_.decimal = value == "comma" ? DecimalSign::comma : DecimalSign::point;
    else
      problem("decimal", ": value \"" + value + "\": allowed: point, comma");
  }

  void take_quantity(const std::string& key, const std::string& value) {
    NamedQuantity named = parse_name(key);
    const NumberAndRest parts = split_number(value);
    const bool unit_follows = named.known && !named.unit_known && !parts.rest.empty();
    if (unit_follows) named = with_unit(named, parts.rest);
    std::optional<double>* const target = named.known ? place_of(named.quantity, facts_.sample) : nullptr;
    if (!target || (named.weak && !(unit_follows && named.unit_known))) return;
    const std::optional<double> amount = value_of(unit_follows ? parts.number : value);
    if (!named.unit_known)
      problem(key, " has no unit that is known: allowed: " + names_of(named.quantity));
    else if (!amount)
      problem(key, ": value \"" + value + "\" is not a number");
    else if (!disbelief(*amount, named).empty())
      problem(key, ": " + disbelief(*amount, named));
    else
      *target = *amount * named.factor;
  }

  std::vector<Problem>& problems_;
  FileFacts facts_;
  std::string series_, bare_spindle_;
  int line_ = 0;
};

}  // namespace

std::string text_of(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string disbelief(double value, const NamedQuantity& named) {
  const QuantityInfo& q = info(named.quantity);
  const double least = (q.least - named.offset) / named.factor;
  const double most = named.percent ? 100 : (q.most - named.offset) / named.factor;
  if (value > least && value <= most) return "";
  return "value " + text_of(value) + ": allowed: > " + text_of(least) + " to " + text_of(most) +
         "; is the unit right?";
}

FileFacts read_facts(const std::vector<Record>& lines, std::vector<Problem>& problems) {
  FactsReader reader(problems);
  for (const Record& line : lines)
    if (line.fields[0].find_first_of("#/") == 0)
      reader.read_comment(line);
    else
      reader.read_line(line);
  return reader.facts();
}

}  // namespace slagflow
