#include "host/case/motion_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "backend/error.hpp"
#include "host/text/number_text.hpp"
#include "host/text/table_text.hpp"

namespace slagflow {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr std::size_t most_rows = 1000000;

struct Unit {
  const char* name;
  double factor;
};
const std::vector<Unit> times{{"s", 1}, {"ms", 1e-3}, {"min", 60}};
const std::vector<Unit> lengths{{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}};
const std::vector<Unit> angles{{"rad", 1}, {"deg", degree}, {"degrees", degree}, {"°", degree}};

enum Kind { time_column, x_column, y_column, z_column, angle_column, kinds };
struct Meaning {
  Kind kind;
  std::vector<const char*> names;
  const std::vector<Unit>& units;
};
const std::vector<Meaning> meanings{{time_column, {"time", "t", "zeit"}, times},
                                    {x_column, {"x", "dx", "displacement_x", "weg_x"}, lengths},
                                    {y_column, {"y", "dy", "displacement_y", "weg_y"}, lengths},
                                    {z_column, {"z", "dz", "displacement_z", "weg_z"}, lengths},
                                    {angle_column, {"angle", "phi", "theta", "winkel"}, angles}};

struct Column {
  int kind = -1;  // of what is not used
  double factor = 1;
};

// "Time [s]", "time_s", "t / s", "angle (deg)" without case: the name and the unit.
Column understand(const std::string& name) {
  std::string text = lower_case(name);
  for (char& c : text)
    if (std::string("[]()/ ").find(c) != std::string::npos) c = '_';
  for (const Meaning& meaning : meanings)
    for (const char* const known : meaning.names) {
      const std::string start = std::string(known) + "_";
      if (text.rfind(start, 0) != 0) continue;
      const std::string rest = replaced(text.substr(start.size()), {{"_", ""}});
      for (const Unit& unit : meaning.units)
        if (rest == unit.name) return {meaning.kind, unit.factor};
    }
  return {};
}

class MotionFile {
 public:
  MotionFile(const std::string& text, Separator separator, WallMotion& motion) : motion_(motion) {
    Records split = split_records(text, separator);
    open_quote_ = split.open_quote;
    for (Record& record : split.records)
      if (record.filled() > 0 && record.fields[0][0] != '#') records_.push_back(std::move(record));
  }

  // The line of names is the first that has a time; what stands above is of no concern. Without one it is the
  // first.
  bool find_header() {
    for (names_ = 0; names_ < records_.size(); ++names_)
      if (has_time(records_[names_].fields, {}) ||
          (names_ + 1 < records_.size() && has_time(records_[names_].fields, records_[names_ + 1].fields)))
        return true;
    names_ = 0;
    if (!records_.empty()) has_time(records_[0].fields, {});
    return false;
  }

  std::string read() {
    if (open_quote_ > 0) return at(open_quote_) + "a quote that is not closed: allowed: \" in pairs";
    if (records_.empty()) return "has no line of column names";
    std::string fault = header();
    if (fault.empty()) fault = decide_sign();
    for (std::size_t k = first_row_; k < records_.size() && fault.empty(); ++k) fault = row(records_[k]);
    if (fault.empty()) finish();
    return fault;
  }

 private:
  static std::string at(int line) { return "line " + std::to_string(line) + ": "; }

  // From names, and the units of the line below where there are any. Whether a time is among them.
  bool has_time(const std::vector<std::string>& names, const std::vector<std::string>& units) {
    columns_.clear();
    for (std::size_t k = 0; k < names.size(); ++k)
      columns_.push_back(understand(names[k] + (k < units.size() ? "_" + units[k] : "")));
    first_row_ = names_ + (units.empty() ? 1 : 2);
    return std::any_of(columns_.begin(), columns_.end(),
                       [](const Column& column) { return column.kind == time_column; });
  }

  std::string header() {
    const std::string line = at(records_[names_].line);
    const std::string allowed =
        ": allowed: a line of names with units: time_s, and x_m, y_m, z_m, angle_rad or angle_deg, as there "
        "are";
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].kind < 0) continue;
      if (has_[columns_[k].kind])
        return line + "'" + records_[names_].fields[k] + "' is the second of its kind" + allowed;
      has_[columns_[k].kind] = true;
    }
    if (!has_[time_column]) return line + "has no time with its unit" + allowed;
    if (!has_[x_column] && !has_[y_column] && !has_[z_column] && !has_[angle_column])
      return line + "has neither a displacement nor an angle with its unit" + allowed;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].kind < 0 && has_numbers(k))
        return line + "'" + records_[names_].fields[k] + "' is no motion with a unit that is known" +
               allowed + "; other columns left out of the file";
    return "";
  }

  // Remarks have none.
  bool has_numbers(std::size_t column) const {
    return std::any_of(
        records_.begin() + static_cast<std::ptrdiff_t>(first_row_), records_.end(), [&](const Record& r) {
          return column < r.fields.size() && (number_of(r.fields[column], DecimalSign::point) ||
                                              number_of(r.fields[column], DecimalSign::comma));
        });
  }

  // From all numbers together: a comma is decimal unless one has a decimal point.
  std::string decide_sign() {
    const Record *point = nullptr, *comma = nullptr;
    std::string with_point, with_comma;
    for (std::size_t r = first_row_; r < records_.size(); ++r)
      for (std::size_t k = 0; k < std::min(columns_.size(), records_[r].fields.size()); ++k) {
        if (columns_[k].kind < 0) continue;
        const std::string& field = records_[r].fields[k];
        const NumberForm form = form_of(field);
        if (form == NumberForm::with_point && !point) point = &records_[r], with_point = field;
        if ((form == NumberForm::with_comma || form == NumberForm::unclear_comma) && !comma)
          comma = &records_[r], with_comma = field;
      }
    sign_ = comma ? DecimalSign::comma : DecimalSign::point;
    if (!point || !comma) return "";
    return at(comma->line) + "'" + with_comma + "' has a comma, '" + with_point + "' in line " +
           std::to_string(point->line) + " a decimal point: allowed: one of them, and none between thousands";
  }

  std::string row(const Record& record) {
    if (record.width() > columns_.size())
      return at(record.line) + "has " + std::to_string(record.width()) + " fields, the line of names " +
             std::to_string(columns_.size()) +
             ": allowed: as many; with decimal commas semicolons or tabs between";
    double values[kinds] = {};
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].kind < 0) continue;
      const std::string field = k < record.fields.size() ? record.fields[k] : "";
      const std::optional<double> value = number_of(field, sign_);
      if (!value) return at(record.line) + "'" + field + "' is not a number";
      if (sign_ == DecimalSign::comma && form_of(field) == NumberForm::unclear_point)
        return at(record.line) + "'" + field +
               "' has a point, where others have decimal commas: allowed: one of them, " +
               "and none between thousands";
      values[columns_[k].kind] = *value * columns_[k].factor;
    }
    if (motion_.time.size() >= most_rows) return at(record.line) + "more than a million rows";
    motion_.time.push_back(values[time_column]);
    motion_.displacement.push_back({values[x_column], values[y_column], values[z_column]});
    motion_.angle.push_back(values[angle_column]);
    return "";
  }

  void finish() {
    if (motion_.time.empty()) return;
    const Vec3d start = motion_.displacement.front();
    const double angle = motion_.angle.front();
    for (Vec3d& d : motion_.displacement) d -= start;
    for (double& a : motion_.angle) a -= angle;
    if (!has_[angle_column]) motion_.angle.clear();
  }

  WallMotion& motion_;
  DecimalSign sign_ = DecimalSign::point;
  int open_quote_ = 0;
  std::vector<Record> records_;  // without comments and empty lines
  std::size_t names_ = 0, first_row_ = 1;
  std::vector<Column> columns_;
  bool has_[kinds] = {};
};

}  // namespace

std::string read_motion_file(const std::string& path, WallMotion& motion) {
  motion.time.clear(), motion.displacement.clear(), motion.angle.clear();
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return "cannot be read";  // a pipe would wait
  std::ifstream file(path, std::ios::binary);
  if (!file) return "cannot be read";
  std::stringstream bytes;
  bytes << file.rdbuf();
  try {
    const std::string text = decode_text(bytes.str(), path).text;
    for (const Separator separator : {Separator::semicolon, Separator::tab}) {
      MotionFile file_of(text, separator, motion);
      if (file_of.find_header()) return file_of.read();
    }
    MotionFile commas(text, Separator::comma, motion);
    commas.find_header();
    return commas.read();
  } catch (const InputError& e) {
    return e.what();
  }
}

}  // namespace slagflow
