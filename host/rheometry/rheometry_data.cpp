#include "host/rheometry/rheometry_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>

#include "backend/error.hpp"
#include "host/case/case_rules.hpp"
#include "host/rheometry/rheometry_units.hpp"

namespace slagflow {
namespace {

constexpr double largest_fall = 0.2;    // of the stress, while the rate rises: more is refused
constexpr double smallest_span = 3;     // largest rate over the smallest
constexpr double least_of_scale = 0.1;  // of the torque sensor, below which its makers vouch for little

std::string text_of(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(line + separator);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(trimmed(part));
  return parts;
}

bool parse_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

struct Point {
  double rate, stress;
  int line;
};

class Reader {
 public:
  Reader(std::string file, const SampleFacts& options) : file_(std::move(file)), given_(options) {}

  Measurements read(const std::string& text) {
    const std::string mark = "\xEF\xBB\xBF";  // that spreadsheets put before UTF-8
    std::stringstream stream(text.compare(0, mark.size(), mark) == 0 ? text.substr(mark.size()) : text);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      const std::string content = trimmed(line);
      if (content.empty()) continue;
      if (content[0] == '#')
        read_comment(content, number);
      else if (header_ == 0)
        read_header(line, number);
      else
        read_row(line, number);
    }
    if (header_ == 0) problem("no line names the columns: allowed: " + allowed_columns());
    raise();
    take_facts();
    convert();
    check_points();
    raise();
    return std::move(result_);
  }

 private:
  struct Column {
    std::string name;
    NamedQuantity meaning;
  };

  static std::string allowed_columns() {
    return "one of " + names_of(Quantity::shear_rate) + " with one of " + names_of(Quantity::shear_stress) +
           "; or one of " + names_of(Quantity::rotation) + " with one of " + names_of(Quantity::torque);
  }
  std::string at(int line) const { return file_ + ":" + std::to_string(line) + ": "; }
  void problem(const std::string& what) {
    problems_ += (problems_.empty() ? "" : "\n") + file_ + ": " + what;
  }
  void problem(int line, const std::string& what) {
    problems_ += (problems_.empty() ? "" : "\n") + at(line) + what;
  }
  void warn(const std::string& what) { result_.warnings.push_back(what); }
  void raise() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

  std::optional<double>* fact(Quantity q) {
    switch (q) {
      case Quantity::bob_radius:
        return &in_file_.bob_radius;
      case Quantity::cup_radius:
        return &in_file_.cup_radius;
      case Quantity::height:
        return &in_file_.height;
      case Quantity::full_scale_torque:
        return &in_file_.full_scale_torque;
      case Quantity::density:
        return &in_file_.density;
      default:
        return nullptr;
    }
  }

  // `# key = value`; comments of another form are prose.
  void read_comment(const std::string& line, int number) {
    const auto equals = line.find('=');
    if (equals == std::string::npos) return;
    const std::string key = trimmed(line.substr(1, equals - 1)), value = trimmed(line.substr(equals + 1));
    if (key == "name") {
      in_file_.name = value;
      return;
    }
    const NamedQuantity meaning = parse_name(key);
    std::optional<double>* const target = meaning.known ? fact(meaning.quantity) : nullptr;
    if (!target) return;
    double amount = 0;
    if (!meaning.unit_known)
      problem(number, "key '" + key + "' has no unit that is known: allowed: " + names_of(meaning.quantity));
    else if (!parse_number(value, amount))
      problem(number, "key '" + key + "': value \"" + value + "\" is not a number");
    else if (believable(number, "key '" + key + "'", amount, meaning))
      *target = amount * meaning.factor;
  }

  // Reports a value that cannot be.
  bool believable(int line, const std::string& what, double value, const NamedQuantity& meaning) {
    const QuantityInfo& q = info(meaning.quantity);
    const double least = q.least / meaning.factor;
    const double most = meaning.percent ? 100 : q.most / meaning.factor;
    if (value > least && value <= most) return true;
    problem(line, what + ": value " + text_of(value) + ": allowed: > " + text_of(least) + " to " +
                      text_of(most) + "; is the unit right?");
    return false;
  }

  void read_header(const std::string& line, int number) {
    header_ = number;
    for (const char candidate : {'\t', ';', ','})
      if (line.find(candidate) != std::string::npos) {
        separator_ = candidate;
        break;
      }
    for (const std::string& name : split(line, separator_)) {
      Column column{name, parse_name(name)};
      const bool measured = column.meaning.known && column.meaning.quantity <= Quantity::torque;
      if (measured && !column.meaning.unit_known)
        problem(number, "column '" + name +
                            "' has no unit that is known: allowed: " + names_of(column.meaning.quantity));
      if (!measured) {
        column.meaning.known = false;
        warn(at(number) + "column '" + name + "' is not used");
      }
      columns_.push_back(column);
    }
    choose_columns();
  }

  int find(Quantity q) {
    int found = -1;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!columns_[k].meaning.known || columns_[k].meaning.quantity != q) continue;
      if (found >= 0)
        problem(header_, "column '" + columns_[k].name + "' gives the " + info(q).name + " twice");
      found = static_cast<int>(k);
    }
    return found;
  }

  void choose_columns() {
    rate_ = find(Quantity::shear_rate), stress_ = find(Quantity::shear_stress);
    const int rotation = find(Quantity::rotation), torque = find(Quantity::torque);
    const bool simple = rate_ >= 0 && stress_ >= 0, cylinders = rotation >= 0 && torque >= 0;
    if (simple && cylinders)
      problem(header_, "both shear rate and stress, and rotation and torque are given: allowed: one pair");
    else if (!simple && !cylinders)
      problem(header_, "the columns are not a pair: allowed: " + allowed_columns());
    cylinders_ = cylinders;
    if (cylinders) rate_ = rotation, stress_ = torque;
  }

  void read_row(const std::string& line, int number) {
    if (!problems_.empty() && (rate_ < 0 || stress_ < 0)) return;
    const std::vector<std::string> fields = split(line, separator_);
    if (fields.size() != columns_.size()) {
      problem(number, std::to_string(fields.size()) + " fields: allowed: " + std::to_string(columns_.size()) +
                          ", as in line " + std::to_string(header_));
      return;
    }
    Point point{0, 0, number};
    const bool good = read_field(fields, rate_, number, point.rate);
    if (read_field(fields, stress_, number, point.stress) && good) points_.push_back(point);
  }

  bool read_field(const std::vector<std::string>& fields, int index, int line, double& value) {
    const Column& column = columns_[static_cast<std::size_t>(index)];
    const std::string &text = fields[static_cast<std::size_t>(index)], what = "column '" + column.name + "'";
    if (!parse_number(text, value)) {
      const bool comma = text.find(',') != std::string::npos;
      problem(line, what + ": value \"" + text + "\" is not a number" +
                        (comma ? ": allowed: a decimal point, not a comma" : ""));
      return false;
    }
    if (!believable(line, what, value, column.meaning)) return false;
    if (column.meaning.percent && value < 100 * least_of_scale)
      warn(at(line) + what + ": value " + text + " is below " + text_of(100 * least_of_scale) +
           " % of full scale, where a torque sensor is uncertain");
    value *= column.meaning.factor;
    return true;
  }

  template <class T>
  static void prefer(std::optional<T>& chosen, const std::optional<T>& option, const std::optional<T>& key) {
    chosen = option ? option : key;
  }

  void take_facts() {
    SampleFacts& facts = result_.facts;
    prefer(facts.bob_radius, given_.bob_radius, in_file_.bob_radius);
    prefer(facts.cup_radius, given_.cup_radius, in_file_.cup_radius);
    prefer(facts.height, given_.height, in_file_.height);
    prefer(facts.full_scale_torque, given_.full_scale_torque, in_file_.full_scale_torque);
    prefer(facts.density, given_.density, in_file_.density);
    prefer(facts.name, given_.name, in_file_.name);
    if (facts.name && (!is_plain_name(*facts.name) || facts.name->find('.') != std::string::npos))
      problem("name \"" + *facts.name + "\": allowed: up to 100 of letters, digits, _ -");
    if (!cylinders_) return;
    need(facts.bob_radius, Quantity::bob_radius, "--bob-radius");
    need(facts.cup_radius, Quantity::cup_radius, "--cup-radius");
    need(facts.height, Quantity::height, "--height");
    if (columns_[static_cast<std::size_t>(stress_)].meaning.percent)
      need(facts.full_scale_torque, Quantity::full_scale_torque, "--full-scale-torque");
    if (facts.bob_radius && facts.cup_radius && !(*facts.bob_radius < *facts.cup_radius))
      problem("cup_radius " + text_of(*facts.cup_radius) + " m: allowed: > bob_radius, " +
              text_of(*facts.bob_radius) + " m");
    raise();
  }

  void need(const std::optional<double>& value, Quantity q, const char* option) {
    if (!value)
      problem("rotation and torque need the " + std::string(info(q).name) + ": allowed: a line `# " +
              info(q).name + "_" + info(q).units[0].name + " = ...` or the option " + option);
  }

  // To the stress at the bob, in ascending order of the rate.
  void convert() {
    std::stable_sort(points_.begin(), points_.end(),
                     [](const Point& a, const Point& b) { return a.rate < b.rate; });
    FlowCurve& curve = result_.curve;
    if (cylinders_)
      curve.cylinders =
          Cylinders{*result_.facts.bob_radius, *result_.facts.cup_radius, *result_.facts.height};
    const bool percent = columns_[static_cast<std::size_t>(stress_)].meaning.percent;
    for (Point& point : points_) {
      if (percent) point.stress *= *result_.facts.full_scale_torque;
      if (cylinders_) point.stress = curve.cylinders->bob_stress(point.stress);
      curve.rate.push_back(point.rate);
      curve.stress.push_back(point.stress);
    }
  }

  void check_points() {
    const int least = points_needed(FlowModel::newtonian);
    if (points_.size() < static_cast<std::size_t>(least)) {
      problem(std::to_string(points_.size()) + " points: allowed: at least " + std::to_string(least));
      return;
    }
    const double span = points_.back().rate / points_.front().rate;
    if (!(span > 1))
      problem("all points have the same rate: allowed: at least two different ones");
    else if (span < smallest_span)
      warn(file_ + ": the largest rate is only " + text_of(span) +
           " times the smallest: the intercept is a guess");
    check_rise();
  }

  void check_rise() {
    const Point* highest = &points_.front();
    for (const Point& point : points_) {
      const bool repeat = point.rate <= highest->rate * (1 + 1e-9);
      const double fall = 1 - point.stress / highest->stress;
      const std::string what = "the stress " + text_of(point.stress) + " Pa is below the " +
                               text_of(highest->stress) + " Pa of line " + std::to_string(highest->line) +
                               (repeat ? " at the same rate" : " at a lower rate");
      if (fall > largest_fall)
        problem(point.line, what + " by " + text_of(std::round(1000 * fall) / 10) + " %: allowed: up to " +
                                text_of(100 * largest_fall) +
                                " %; no curve of a yield stress falls: wall slip, settling or a slow "
                                "recovery of the sample?");
      else if (fall > 0 && !repeat)
        warn(at(point.line) + what);
      if (point.stress >= highest->stress) highest = &point;
    }
  }

  std::string file_;
  SampleFacts given_, in_file_;
  Measurements result_;
  std::vector<Column> columns_;
  std::vector<Point> points_;
  std::string problems_;
  char separator_ = ',';
  int header_ = 0, rate_ = -1, stress_ = -1;
  bool cylinders_ = false;
};

}  // namespace

Measurements parse_measurements(const std::string& text, const std::string& file,
                                const SampleFacts& options) {
  return Reader(file, options).read(text);
}

Measurements read_measurements(const std::string& path, const SampleFacts& options) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read " + path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw InputError("cannot read " + path + ": is it a folder?");
  return parse_measurements(text.str(), path, options);
}

}  // namespace slagflow
