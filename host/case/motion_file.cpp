#include "host/case/motion_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

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
const std::vector<Meaning> meanings{{time_column, {"time", "t"}, times},
                                    {x_column, {"x", "dx", "displacement_x"}, lengths},
                                    {y_column, {"y", "dy", "displacement_y"}, lengths},
                                    {z_column, {"z", "dz", "displacement_z"}, lengths},
                                    {angle_column, {"angle", "phi", "theta"}, angles}};

struct Column {
  int kind = -1;  // of what is not used
  double factor = 1;
};

std::string trimmed(const std::string& text) {
  const char* const blank = " \t\r\"'";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::size_t from = 0;
  for (std::size_t at = 0; at <= line.size(); ++at)
    if (at == line.size() || line[at] == separator) {
      fields.push_back(trimmed(line.substr(from, at - from)));
      from = at + 1;
    }
  return fields;
}

char separator_of(const std::string& line) {
  for (const char separator : {';', '\t'})
    if (line.find(separator) != std::string::npos) return separator;
  return ',';
}

// "Time [s]", "time_s", "t / s", "angle (deg)" without case: the name and the unit.
bool understand(std::string text, Column& column) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (char& c : text)
    if (c == '[' || c == ']' || c == '(' || c == ')' || c == '/' || c == ' ') c = '_';
  for (const Meaning& meaning : meanings)
    for (const char* const name : meaning.names) {
      const std::string start = std::string(name) + "_";
      if (text.rfind(start, 0) != 0) continue;
      std::string unit = text.substr(start.size());
      unit.erase(std::remove(unit.begin(), unit.end(), '_'), unit.end());
      for (const Unit& known : meaning.units)
        if (unit == known.name) {
          column = {meaning.kind, known.factor};
          return true;
        }
    }
  return false;
}

bool number(std::string text, bool decimal_comma, double& value) {
  if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == 0 && std::isfinite(value);
}

class MotionFile {
 public:
  explicit MotionFile(WallMotion& motion) : motion_(motion) {}

  std::string read(const std::string& path) {
    std::ifstream file(path);
    if (!file) return "cannot be read";
    std::size_t count = 0;
    for (std::string line; std::getline(file, line);) {
      ++count;
      if (count == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);
      if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
      const std::string fault = columns_.empty() ? header(line) : row(line);
      if (!fault.empty()) return "line " + std::to_string(count) + ": " + fault;
    }
    if (columns_.empty()) return "has no line of column names";
    finish();
    return "";
  }

 private:
  std::string header(const std::string& line) {
    separator_ = separator_of(line);
    const std::string allowed =
        ": allowed: a line of names with units: time_s, and x_m, y_m, z_m, angle_rad or angle_deg, as there "
        "are";
    for (const std::string& field : split(line, separator_)) {
      Column column;
      understand(field, column);
      if (column.kind >= 0 && has_[column.kind]) return "'" + field + "' is the second of its kind" + allowed;
      if (column.kind >= 0) has_[column.kind] = true;
      columns_.push_back(column);
    }
    if (!has_[time_column]) return "has no time with its unit" + allowed;
    if (!has_[x_column] && !has_[y_column] && !has_[z_column] && !has_[angle_column])
      return "has neither a displacement nor an angle with its unit" + allowed;
    return "";
  }

  std::string row(const std::string& line) {
    const std::vector<std::string> fields = split(line, separator_);
    for (std::size_t k = columns_.size(); k < fields.size(); ++k)
      if (!fields[k].empty())
        return "has " + std::to_string(fields.size()) + " fields, the line of names " +
               std::to_string(columns_.size()) +
               ": allowed: as many; with decimal commas semicolons or tabs between";
    double values[kinds] = {};
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].kind < 0) continue;
      double value = 0;
      if (k >= fields.size() || !number(fields[k], separator_ != ',', value))
        return "'" + (k < fields.size() ? fields[k] : std::string()) + "' is not a number";
      values[columns_[k].kind] = value * columns_[k].factor;
    }
    if (motion_.time.size() >= most_rows) return "more than a million rows";
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
  std::vector<Column> columns_;
  bool has_[kinds] = {};
  char separator_ = ',';
};

}  // namespace

std::string read_motion_file(const std::string& path, WallMotion& motion) {
  motion.time.clear(), motion.displacement.clear(), motion.angle.clear();
  return MotionFile(motion).read(path);
}

}  // namespace slagflow
