#include "host/rheometry/rheometry_readings.hpp"

#include <algorithm>
#include <cmath>

#include "host/rheometry/rheometry_columns.hpp"
#include "host/rheometry/rheometry_facts.hpp"

namespace slagflow {
namespace {

constexpr double least_of_scale = 0.1;       // of the torque sensor, below which its makers vouch for little
constexpr double viscosity_mismatch = 0.05;  // between a viscosity and stress over rate

struct Pair {
  Quantity first, second;
};

// First come, first taken.
std::vector<Pair> pairs(const ReadingsOptions& options) {
  using Q = Quantity;
  std::vector<Pair> shear{
      {Q::shear_rate, Q::shear_stress}, {Q::shear_rate, Q::viscosity}, {Q::shear_stress, Q::viscosity}};
  std::vector<Pair> cylinders{{Q::rotation, Q::torque}};
  if (options.spindle) cylinders.push_back({Q::rotation, Q::viscosity});
  std::vector<Pair>& before = options.cylinders ? cylinders : shear;
  const std::vector<Pair>& after = options.cylinders ? shear : cylinders;
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

struct Chosen {
  const Block* block;
  std::size_t table;
  int first, second, viscosity, temperature;  // columns
};

class Reader {
 public:
  Reader(const Tables& tables, const ReadingsOptions& options, const std::string& file,
         std::vector<Problem>& problems)
      : tables_(tables), options_(options), file_(file), problems_(problems) {}

  Readings read() {
    choose_pair();
    if (!problems_.empty()) return std::move(result_);
    decide_sign();
    for (const Chosen& chosen : chosen_)
      for (const Record& row : chosen.block->rows) take(row, chosen);
    tell_left_out();
    warn_of_viscosity();
    if (!result_.over_temperature) warn_of_temperature();
    result_.how = how();
    return std::move(result_);
  }

 private:
  void problem(int line, const std::string& what) { problems_.push_back({line, what}); }
  void warn(int line, const std::string& what) {
    result_.warnings.push_back(file_ + ":" + std::to_string(line) + ": " + what);
  }
  static const Column& column(const Chosen& c, int k) {
    return c.block->columns[static_cast<std::size_t>(k)];
  }
  static const std::string& field(const Record& row, int k) {
    return row.fields[static_cast<std::size_t>(k)];
  }

  std::vector<std::size_t> wanted_tables() {
    const std::size_t count = tables_.blocks.size();
    if (options_.only && (*options_.only < 1 || static_cast<std::size_t>(*options_.only) > count))
      problem(0, "table " + std::to_string(*options_.only) + ": allowed: 1 to " + std::to_string(count));
    std::vector<std::size_t> wanted;
    for (std::size_t k = 0; k < count; ++k)
      if (!options_.only || static_cast<int>(k) + 1 == *options_.only) wanted.push_back(k);
    return wanted;
  }

  // The pair that all wanted tables have, with units if there is such a one.
  void choose_pair() {
    const std::vector<std::size_t> wanted = wanted_tables();
    if (wanted.empty()) return;
    result_.over_temperature = are_series(wanted);
    std::vector<Pair> all = pairs(options_);
    const bool flows = std::all_of(wanted.begin(), wanted.end(),
                                   [&](std::size_t k) { return tables_.blocks[k].has_flow_pair(); });
    if (result_.over_temperature || !flows)
      all.insert(all.begin(), {Quantity::temperature, Quantity::viscosity});
    for (const bool with_units : {true, false})
      for (const Pair& pair : all) {
        if (!std::all_of(wanted.begin(), wanted.end(),
                         [&](std::size_t k) { return has(tables_.blocks[k], pair, with_units); }))
          continue;
        result_.first = pair.first, result_.second = pair.second;
        for (const std::size_t k : wanted) choose_columns(k);
        return;
      }
    const int line = tables_.blocks[wanted[0]].line;
    if (wanted.size() > 1)
      problem(line, "the tables of the file have no pair of quantities in common: allowed: --table 1 to " +
                        std::to_string(tables_.blocks.size()) + " for one of them");
    else
      problem(line,
              "rotation and viscosity need the spindle: allowed: a line `# spindle = LV-1` or the option "
              "--spindle; or --over-temperature, with a temperature; or another pair: " +
                  allowed_columns());
  }

  bool are_series(const std::vector<std::size_t>& wanted) {
    std::size_t count = 0;
    for (const std::size_t k : wanted) count += is_series(tables_.blocks[k], options_.over_temperature);
    if (options_.over_temperature && count < wanted.size())
      problem(tables_.blocks[wanted[0]].line,
              "no temperature with a unit: allowed with --over-temperature: a column " +
                  names_of(Quantity::temperature));
    return count == wanted.size();
  }

  static bool has(const Block& block, const Pair& pair, bool with_units) {
    for (const Quantity q : {pair.first, pair.second}) {
      const int k = block.column_of(q);
      if (k < 0 || (with_units && !block.columns[static_cast<std::size_t>(k)].meaning.unit_known))
        return false;
      if (with_units && is_zero(block, k)) return false;
    }
    return true;
  }

  void choose_columns(std::size_t k) {
    const Block& block = tables_.blocks[k];
    Chosen chosen{&block, k, one_of(block, result_.first), one_of(block, result_.second), -1, -1};
    if (result_.over_temperature) chosen.temperature = block.column_of(Quantity::temperature);
    if (result_.second == Quantity::shear_stress || result_.second == Quantity::torque)
      chosen.viscosity = block.column_of(Quantity::viscosity);
    const bool percent = column(chosen, chosen.second).meaning.percent;
    if (!chosen_.empty() && percent != result_.percent)
      problem(block.line, "torque in per cent and not in per cent: allowed: one of them in all tables");
    result_.percent = percent;
    chosen_.push_back(chosen);
    warn_of_unused(chosen);
  }

  // A torque in N m goes before one in per cent.
  int one_of(const Block& block, Quantity q) {
    std::vector<int> found = block.columns_of(q), good;
    const auto meaning = [&](int k) { return block.columns[static_cast<std::size_t>(k)].meaning; };
    for (const int k : found)
      if (meaning(k).unit_known) good.push_back(k);
    if (good.empty()) {
      const Column& bad = block.columns[static_cast<std::size_t>(found[0])];
      problem(block.units_line ? block.units_line : block.line,
              "column '" + bad.name + "' has no unit that is known" +
                  (bad.meaning.unit.empty() ? "" : ", but '" + bad.meaning.unit + "'") +
                  ": allowed: " + names_of(q));
      return found[0];
    }
    const auto percent = std::find_if(good.begin(), good.end(), [&](int k) { return meaning(k).percent; });
    if (good.size() == 2 && percent != good.end()) good.erase(percent);
    if (good.size() > 1)
      problem(block.line, "column '" + block.columns[static_cast<std::size_t>(good[1])].name +
                              "' gives the " + info(q).name + " twice");
    return good[0];
  }

  void warn_of_unused(const Chosen& chosen) {
    std::string names;
    int count = 0;
    for (int k = 0; k < static_cast<int>(chosen.block->columns.size()); ++k) {
      const std::string& name = column(chosen, k).name;
      if (k == chosen.first || k == chosen.second || k == chosen.viscosity || k == chosen.temperature ||
          name.empty())
        continue;
      names += (count++ > 0 ? ", '" : "'") + name + "'";
    }
    if (count > 0 && chosen_.size() == 1)
      warn(chosen.block->line,
           (count > 1 ? "columns " : "column ") + names + (count > 1 ? " are" : " is") + " not used");
  }

  // The number in a field. A unit may follow it that is the column's.
  static std::string number_in(const Record& row, const Chosen& chosen, int k) {
    const NumberAndRest parts = split_number(field(row, k));
    const NamedQuantity& meaning = column(chosen, k).meaning;
    const bool same = !parts.rest.empty() && with_unit(meaning, parts.rest).unit_known &&
                      with_unit(meaning, parts.rest).unit == meaning.unit;
    return same ? parts.number : field(row, k);
  }

  // Those that make up a reading, in the order in which they are told.
  static std::vector<int> columns_of(const Chosen& chosen) {
    std::vector<int> columns{chosen.first, chosen.second};
    if (chosen.temperature >= 0 && chosen.temperature != chosen.first) columns.push_back(chosen.temperature);
    return columns;
  }

  struct Place {
    int line = 0;
    std::string text;
  };

  // From all numbers that are taken. Those that may be read in two ways decide nothing.
  void decide_sign() {
    Place point, comma, unclear;
    for (const Chosen& chosen : chosen_)
      for (const Record& row : chosen.block->rows)
        for (const int k : columns_of(chosen)) {
          const Place here{row.line, number_in(row, chosen, k)};
          const NumberForm form = form_of(here.text);
          if (form == NumberForm::with_point && point.line == 0) point = here;
          if (form == NumberForm::with_comma && comma.line == 0) comma = here;
          if (form == NumberForm::unclear_comma && unclear.line == 0) unclear = here;
        }
    sign_ = options_.decimal.value_or(comma.line ? DecimalSign::comma : DecimalSign::point);
    if (options_.decimal) return;
    if (point.line && comma.line)
      problem(comma.line, "value \"" + comma.text + "\" has a decimal comma, \"" + point.text +
                              "\" in line " + std::to_string(point.line) +
                              " a decimal point: allowed: one of them in a file");
    else if (unclear.line && !point.line && !comma.line)
      problem(unclear.line,
              "value \"" + unclear.text +
                  "\" may have a decimal comma or one between thousands: allowed: a line `# decimal = "
                  "comma` or `# decimal = point`");
  }

  std::string why_no_number(const std::string& text) const {
    if (text.empty()) return "no value: allowed: a number";
    const NumberForm form = form_of(text);
    if (form == NumberForm::no_number) return "value " + quoted(text) + " is not a number";
    const bool other_sign =
        form == (sign_ == DecimalSign::comma ? NumberForm::with_point : NumberForm::with_comma);
    return "value " + quoted(text) + (other_sign ? ": allowed: the decimal sign of the file" : ": too large");
  }

  bool take_field(const Record& row, const Chosen& chosen, int k, double& value) {
    const std::string text = number_in(row, chosen, k), what = "column '" + column(chosen, k).name + "': ";
    const std::optional<double> number = number_of(text, sign_);
    if (!number) {
      problem(row.line, what + why_no_number(text));
      return false;
    }
    const NamedQuantity& meaning = column(chosen, k).meaning;
    if (const std::string why = disbelief(*number, meaning); !why.empty()) {
      problem(row.line, what + why);
      return false;
    }
    const NumberForm two_ways =
        sign_ == DecimalSign::comma ? NumberForm::unclear_point : NumberForm::unclear_comma;
    if (form_of(text) == two_ways)
      warn(row.line, what + "value " + quoted(text) + " is read as " + text_of(*number));
    if (meaning.percent && *number < 100 * least_of_scale)
      warn(row.line, what + "value " + text + " is below " + text_of(100 * least_of_scale) +
                         " % of full scale, where a torque sensor is uncertain");
    value = meaning.si(*number);
    return true;
  }

  // Rows that the instrument marks as none, with the mark.
  bool leave_out(const Record& row, const Chosen& chosen) {
    for (const int k : columns_of(chosen))
      if (stands_for_no_number(field(row, k))) {
        left_out_.push_back({row.line, field(row, k)});
        return true;
      }
    return false;
  }

  void tell_left_out() {
    constexpr std::size_t most_told = 10;
    const std::size_t count = left_out_.size();
    if (count == 0) return;
    std::string lines;
    for (std::size_t k = 0; k < std::min(count, most_told); ++k)
      lines +=
          (k > 0 ? ", " : " ") + std::to_string(left_out_[k].line) + " (" + quoted(left_out_[k].text) + ")";
    if (count > most_told) lines += " and " + std::to_string(count - most_told) + " more";
    const std::string what = std::to_string(count) + (count > 1 ? " rows have" : " row has") +
                             " no reading: line" + (count > 1 ? "s" : "") + lines;
    if (count > result_.readings.size())
      problem(left_out_[0].line, what + ": allowed: up to half of all rows");
    else
      warn(left_out_[0].line, what + (count > 1 ? "; they are" : "; it is") + " left out");
  }

  void take(const Record& row, const Chosen& chosen) {
    if (leave_out(row, chosen)) return;
    Reading reading{0, 0, row.line, chosen.table, viscosity_of(row, chosen), 0};
    bool good = take_field(row, chosen, chosen.first, reading.first);
    if (chosen.temperature == chosen.first)
      reading.temperature = reading.first;
    else if (chosen.temperature >= 0)
      good = take_field(row, chosen, chosen.temperature, reading.temperature) && good;
    if (!take_field(row, chosen, chosen.second, reading.second) || !good) return;
    result_.readings.push_back(reading);
    const double given = reading.viscosity;
    if (result_.second == Quantity::torque || !(given > 0)) return;
    if (std::abs(reading.second / (reading.first * given) - 1) > viscosity_mismatch && mismatches_++ == 0)
      mismatch_ = {row.line, "the viscosity is " + text_of(given) + " Pa s, but stress over rate " +
                                 text_of(reading.second / reading.first) + " Pa s"};
  }

  // [Pa s] of its column beside the pair; 0: none.
  double viscosity_of(const Record& row, const Chosen& chosen) const {
    if (chosen.viscosity < 0 || !column(chosen, chosen.viscosity).meaning.unit_known) return 0;
    const std::optional<double> viscosity = number_of(field(row, chosen.viscosity), sign_);
    return viscosity && *viscosity > 0 ? *viscosity * column(chosen, chosen.viscosity).meaning.factor : 0;
  }

  // Viscosity depends on it strongly.
  void warn_of_temperature() {
    for (const Chosen& chosen : chosen_)
      for (int k = 0; k < static_cast<int>(chosen.block->columns.size()); ++k) {
        const NamedQuantity& meaning = column(chosen, k).meaning;
        const bool known = meaning.known && meaning.quantity == Quantity::temperature;
        if (!known && lower_case(column(chosen, k).name).rfind("temp", 0) != 0) continue;
        const auto [low, high] = range_of(*chosen.block, k);
        if (high - low > temperature_spread)
          warn(chosen.block->line,
               "the temperature goes from " + text_of(low) + " to " + text_of(high) + " in column '" +
                   column(chosen, k).name +
                   "': a flow curve is of one temperature; --over-temperature takes it for viscosity over "
                   "temperature");
      }
  }

  void warn_of_viscosity() {
    if (mismatches_ > 0)
      warn(mismatch_.line,
           mismatch_.text + (mismatches_ > 1 ? ", and so in " + std::to_string(mismatches_) + " lines" : "") +
               ": are the units right?");
  }

  std::string how() const {
    const Chosen& one = chosen_[0];
    std::string text = std::string("separated by ") + name_of(tables_.separator) + ", decimal " +
                       (sign_ == DecimalSign::comma ? "comma" : "point");
    text += ": " + std::to_string(result_.readings.size()) + " rows";
    if (!result_.readings.empty())
      text += " in lines " + std::to_string(result_.readings.front().line) + " to " +
              std::to_string(result_.readings.back().line);
    if (chosen_.size() > 1) text += " of " + std::to_string(chosen_.size()) + " tables";
    for (const int k : columns_of(one))
      text += (k == one.first ? "; " : ", ") + std::string(info(column(one, k).meaning.quantity).name) +
              " in " + column(one, k).meaning.unit + " from '" + column(one, k).name + "'";
    return text;
  }

  const Tables& tables_;
  const ReadingsOptions& options_;
  const std::string& file_;
  std::vector<Problem>& problems_;
  Readings result_;
  std::vector<Chosen> chosen_;
  DecimalSign sign_ = DecimalSign::point;
  Place mismatch_;
  std::vector<Place> left_out_;
  int mismatches_ = 0;
};

}  // namespace

Readings read_tables(const Tables& tables, const ReadingsOptions& options, const std::string& file,
                     std::vector<Problem>& problems) {
  return Reader(tables, options, file, problems).read();
}

}  // namespace slagflow
