#include "host/rheometry/rheometry_data.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "backend/error.hpp"
#include "host/case/case_rules.hpp"
#include "host/rheometry/rheometry_facts.hpp"
#include "host/rheometry/rheometry_readings.hpp"
#include "host/rheometry/rheometry_spindles.hpp"

namespace slagflow {
namespace {

constexpr double largest_fall = 0.2;        // of the stress, while the rate rises: more is refused
constexpr double largest_scatter = 0.05;    // of the stress at one rate, unwarned
constexpr double smallest_span = 3;         // largest rate over the smallest
constexpr double same_temperature = 1;      // [K]
constexpr double largest_difference = 0.2;  // of the viscosity there, unwarned
constexpr double least_range = 10;          // [K] of a series over temperature
constexpr std::size_t most_problems = 20;   // that are told

struct Point {
  double rate, stress;
  int line;
};

struct MeltPoint {
  double temperature, viscosity;
  int line;
};

class Reader {
 public:
  Reader(std::string file, const SampleFacts& options) : file_(std::move(file)), given_(options) {}

  Measurements read(const std::string& bytes) {
    const DecodedText decoded = decode_text(bytes, file_);
    const Tables tables = find_tables(decoded.text);
    problems_ = tables.problems;
    in_file_ = read_facts(tables.others, problems_);
    raise();
    take_facts();
    read_rows(tables);
    result_.how = decoded.encoding + ", " + readings_.how;
    raise();
    require_facts();
    raise();
    convert();
    if (readings_.over_temperature)
      check_series();
    else
      check_points();
    raise();
    return std::move(result_);
  }

 private:
  void problem(const std::string& what) { problems_.push_back({0, what}); }
  void problem(int line, const std::string& what) { problems_.push_back({line, what}); }
  std::string at(int line) const { return file_ + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " "; }
  void warn(const std::string& what) { result_.warnings.push_back(what); }
  void raise() const {
    if (problems_.empty()) return;
    std::string all;
    for (std::size_t k = 0; k < std::min(problems_.size(), most_problems); ++k)
      all += (k > 0 ? "\n" : "") + at(problems_[k].line) + problems_[k].what;
    if (problems_.size() > most_problems)
      all += "\n" + file_ + ": and " + std::to_string(problems_.size() - most_problems) + " more of them";
    throw InputError(all);
  }

  template <class T>
  static void prefer(std::optional<T>& chosen, const std::optional<T>& option, const std::optional<T>& key) {
    chosen = option ? option : key;
  }

  void take_facts() {
    SampleFacts& facts = result_.facts;
    const SampleFacts& in_file = in_file_.sample;
    prefer(facts.bob_radius, given_.bob_radius, in_file.bob_radius);
    prefer(facts.cup_radius, given_.cup_radius, in_file.cup_radius);
    prefer(facts.height, given_.height, in_file.height);
    prefer(facts.full_scale_torque, given_.full_scale_torque, in_file.full_scale_torque);
    prefer(facts.density, given_.density, in_file.density);
    prefer(facts.name, given_.name, in_file.name);
    prefer(facts.spindle, given_.spindle, in_file.spindle);
    facts.table = given_.table;
    if (facts.name && (!is_plain_name(*facts.name) || facts.name->find('.') != std::string::npos))
      problem("name \"" + *facts.name + "\": allowed: up to 100 of letters, digits, _ -");
    warn_of_other_units();
    if (!facts.spindle) return;
    spindle_ = find_spindle(*facts.spindle);
    if (!spindle_) problem("spindle \"" + *facts.spindle + "\": allowed: " + allowed_spindles);
  }

  // Options are in SI units; in files such values are refused.
  void warn_of_other_units() {
    const auto check = [&](const std::optional<double>& value, Quantity q, const char* option) {
      if (value && *value > info(q).most)
        warn(std::string(option) + " " + text_of(*value) +
             " m is larger than any viscometer's: is it meant in mm? Then " + text_of(*value / 1e3) + " m");
    };
    check(given_.bob_radius, Quantity::bob_radius, "--bob-radius");
    check(given_.cup_radius, Quantity::cup_radius, "--cup-radius");
    check(given_.height, Quantity::height, "--height");
    if (given_.density && *given_.density <= info(Quantity::density).least)
      warn("--density " + text_of(*given_.density) +
           " kg/m3 is less than any melt's: is it meant in g/cm3? Then " + text_of(*given_.density * 1e3));
  }

  void read_rows(const Tables& tables) {
    const SampleFacts& facts = result_.facts;
    ReadingsOptions options;
    options.decimal = in_file_.decimal;
    options.spindle = spindle_.has_value();
    options.cylinders = spindle_ || (facts.bob_radius && facts.cup_radius && facts.height);
    options.only = facts.table;
    options.over_temperature = given_.over_temperature;
    readings_ = read_tables(tables, options, file_, problems_);
    result_.warnings.insert(result_.warnings.end(), readings_.warnings.begin(), readings_.warnings.end());
    several_ = tables.blocks.size() > 1 && !facts.table;
    if (several_)
      warn(file_ + ": the " + std::to_string(tables.blocks.size()) + " tables of lines" + lines_of(tables) +
           " are taken together; --table 1 takes the first alone");
  }

  static std::string lines_of(const Tables& tables) {
    std::string lines;
    for (const Block& block : tables.blocks)
      lines += (lines.empty() ? " " : ", ") + std::to_string(block.line);
    return lines;
  }

  bool has_viscosities() const { return readings_.first == Quantity::temperature; }
  bool rotates() const { return readings_.first == Quantity::rotation; }

  void require_facts() {
    SampleFacts& facts = result_.facts;
    if (!rotates()) {
      if (spindle_)
        warn(file_ + ": the spindle is not used: " +
             (has_viscosities() ? "viscosities are" : "shear rate and stress are") + " given");
      facts.spindle.reset();
      return;
    }
    if (spindle_) {
      if (facts.bob_radius || facts.cup_radius || facts.height)
        problem("a spindle and radii or a height are given: allowed: one of them");
      facts.spindle = spindle_->name;
      facts.full_scale_torque = spindle_->full_scale;
      return;
    }
    need(facts.bob_radius, Quantity::bob_radius, "--bob-radius");
    need(facts.cup_radius, Quantity::cup_radius, "--cup-radius");
    need(facts.height, Quantity::height, "--height");
    if (readings_.percent) need(facts.full_scale_torque, Quantity::full_scale_torque, "--full-scale-torque");
    if (facts.bob_radius && facts.cup_radius && !(*facts.bob_radius < *facts.cup_radius))
      problem("cup_radius " + text_of(*facts.cup_radius) + " m: allowed: > bob_radius, " +
              text_of(*facts.bob_radius) + " m");
  }

  void need(const std::optional<double>& value, Quantity q, const char* option) {
    if (!value)
      problem("rotation and torque need the " + std::string(info(q).name) + ": allowed: a line `# " +
              info(q).name + "_" + info(q).units[0].name + " = ...` or the option " + option +
              "; or --spindle with one of " + allowed_spindles);
  }

  // To rate and stress, at the bob between cylinders.
  Point point_of(const Reading& reading) const {
    const auto& cylinders = result_.curve.cylinders;
    const double a = reading.first, b = reading.second;
    if (readings_.first == Quantity::shear_stress) return {a / b, a, reading.line};
    if (readings_.second == Quantity::viscosity)
      return {a, b * (cylinders ? cylinders->nominal_rate(a) : a), reading.line};
    const double torque = readings_.percent ? b * *result_.facts.full_scale_torque : b;
    return {a, cylinders ? cylinders->bob_stress(torque) : b, reading.line};
  }

  void convert() {
    FlowCurve& curve = result_.curve;
    const SampleFacts& facts = result_.facts;
    if (rotates())
      curve.cylinders =
          spindle_ ? spindle_->cylinders() : Cylinders{*facts.bob_radius, *facts.cup_radius, *facts.height};
    if (has_viscosities()) {
      for (const Reading& reading : readings_.readings)
        series_.push_back({reading.temperature, reading.second, reading.line});
      return;
    }
    for (const Reading& reading : readings_.readings) points_.push_back(point_of(reading));
    warn_of_other_viscosity();
    if (readings_.over_temperature) {
      for (std::size_t k = 0; k < points_.size(); ++k)
        series_.push_back({readings_.readings[k].temperature, viscosity_of(points_[k]), points_[k].line});
      return;
    }
    std::stable_sort(points_.begin(), points_.end(),
                     [](const Point& a, const Point& b) { return a.rate < b.rate; });
    for (const Point& point : points_) {
      curve.rate.push_back(point.rate);
      curve.stress.push_back(point.stress);
    }
  }

  // [Pa s] as of a Newtonian fluid.
  double viscosity_of(const Point& point) const {
    const auto& cylinders = result_.curve.cylinders;
    return point.stress / (cylinders ? cylinders->nominal_rate(point.rate) : point.rate);
  }

  // Of the file beside the one of torque and geometry; the first that differs.
  void warn_of_other_viscosity() {
    constexpr double most = 1.5;
    for (std::size_t k = 0; k < points_.size() && result_.curve.cylinders; ++k) {
      const double given = readings_.readings[k].viscosity;
      const double here = viscosity_of(points_[k]);
      if (!(given > 0) || (here < most * given && given < most * here)) continue;
      warn(at(points_[k].line) + "the file gives a viscosity of " + text_of(given) +
           " Pa s, rotation and torque " + text_of(here) +
           " Pa s: " + (spindle_ ? "the wrong spindle, or another series?" : "the right radii and height?"));
      return;
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

  void check_series() {
    std::stable_sort(series_.begin(), series_.end(),
                     [](const MeltPoint& a, const MeltPoint& b) { return a.temperature < b.temperature; });
    int told = 0;
    for (std::size_t k = 0; k < series_.size(); ++k) {
      const MeltPoint& here = series_[k];
      result_.series.temperature.push_back(here.temperature);
      result_.series.viscosity.push_back(here.viscosity);
      if (k == 0 || here.temperature - series_[k - 1].temperature > same_temperature) continue;
      const double ratio = here.viscosity / series_[k - 1].viscosity;
      if (std::abs(std::log(ratio)) > std::log(1 + largest_difference) && told++ == 0)
        warn(at(here.line) + "the viscosity " + text_of(here.viscosity) + " Pa s and the " +
             text_of(series_[k - 1].viscosity) + " Pa s of line " + std::to_string(series_[k - 1].line) +
             " are at one temperature: does the sample change, or do heating and cooling differ?");
    }
    if (series_.size() < 2 || series_.back().temperature - series_.front().temperature < least_range)
      problem(std::to_string(series_.size()) + " readings over a range of temperature of " +
              text_of(series_.empty() ? 0 : series_.back().temperature - series_.front().temperature) +
              " K: allowed: at least " + text_of(least_range) + " K, for viscosity over temperature");
  }

  void check_rise() {
    const Point* highest = &points_.front();
    std::vector<Problem> falls;
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
                                "recovery of the sample?" +
                                (several_ ? " Tables of different samples? --table takes one" : ""));
      else if (fall > (repeat ? largest_scatter : 0))
        falls.push_back(
            {point.line,
             what + (repeat ? ": does the sample change with time? Runs up and down give two curves" : "")});
      if (point.stress >= highest->stress) highest = &point;
    }
    tell(falls);
  }

  void tell(const std::vector<Problem>& falls) {
    constexpr std::size_t most = 5;
    for (std::size_t k = 0; k < std::min(falls.size(), most); ++k) warn(at(falls[k].line) + falls[k].what);
    if (falls.size() > most)
      warn(file_ + ": and " + std::to_string(falls.size() - most) + " more readings below others");
  }

  std::string file_;
  SampleFacts given_;
  FileFacts in_file_;
  std::optional<Spindle> spindle_;
  Readings readings_;
  Measurements result_;
  std::vector<Point> points_;
  std::vector<MeltPoint> series_;
  std::vector<Problem> problems_;
  bool several_ = false;  // tables are taken together
};

}  // namespace

Measurements parse_measurements(const std::string& text, const std::string& file,
                                const SampleFacts& options) {
  return Reader(file, options).read(text);
}

std::string read_whole_file(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw InputError(path + ": is a folder: allowed: a file with readings");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read " + path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw InputError("cannot read " + path + ": is it a folder?");
  return text.str();
}

Measurements read_measurements(const std::string& path, const SampleFacts& options) {
  return parse_measurements(read_whole_file(path), path, options);
}

}  // namespace slagflow
