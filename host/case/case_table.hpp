// Typed reading of one table of a case file. What is wrong is collected, so that one pass reports it all.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fluid/math.hpp"
#include "host/case/toml_reader.hpp"

namespace slagflow {

enum class Need { optional, required };
enum class Bound { closed, open };

// The numbers allowed for a key. Single precision holds nothing larger than the outermost limits.
struct Range {
  static constexpr double largest = 1e30;
  double lower = -largest, upper = largest;
  Bound lower_bound = Bound::closed, upper_bound = Bound::closed;
  std::string unit{};
  std::string doubt{};  // said of a number that is not allowed

  bool holds(double value) const;
  std::string text() const;  // "> 0 [kg/m^3]"
  // The same, with the outermost limit where this value is beyond it.
  std::string text_for(double value) const;

 private:
  std::string text(bool outermost) const;
};
Range any_number(const std::string& unit);
Range above(double lower, const std::string& unit);
Range at_least(double lower, const std::string& unit);
Range between(double lower, double upper, const std::string& unit);
Range above_to(double lower, double upper, const std::string& unit);  // without the lower
Range inside(double lower, double upper, const std::string& unit);    // without both

// What is wrong with a case so far, and where each key stands.
class CaseProblems {
 public:
  CaseProblems(std::string file, const TomlFile& source) : file_(std::move(file)), source_(source) {}

  Place place_of(const Toml& value) const { return source_.place_of(value); }

  void note(const std::string& key, const Place& place);
  // Adds "PLACE: key 'KEY': WHAT".
  void add(const std::string& key, const std::string& what);
  void add_missing(const std::string& key, const Place& place, const std::string& allowed);
  // Of a key that is not known; the first of them are told, of the rest the number.
  void add_unknown(const std::string& key, const std::string& what, bool before_others);
  // Adds a message that names its place itself.
  void add_message(const std::string& message);
  // Whether none of these keys has been reported.
  bool fine(std::initializer_list<std::string> keys) const;
  // Whether none of the keys in a table has.
  bool fine_within(const std::string& table) const;
  // Throws InputError with one line per problem, in the order of the file, up to a number of each kind.
  void raise() const;

  const std::map<std::string, Place>& places() const { return places_; }

 private:
  enum class Kind { unknown_key, other };
  struct Problem {
    long order;
    std::string message;
    Kind kind = Kind::other;
  };
  Place place_of(const std::string& key) const;

  std::string file_;
  const TomlFile& source_;
  std::map<std::string, Place> places_;
  std::set<std::string> faulty_;
  std::vector<Problem> problems_;
};

// One table, or a table that the file leaves out (all keys missing). Each key must be asked for exactly
// as the format knows it; unknown() are the others. A read leaves its target alone and returns
// false when the key is missing or faulty.
class CaseTable {
 public:
  CaseTable(const Toml* table, std::string path, Place place, CaseProblems& problems);

  bool read(const char* key, double& target, const Range& range, Need need = Need::optional);
  bool read(const char* key, Vec3d& target, const Range& range, Need need = Need::optional);
  bool read(const char* key, bool& target);
  bool read(const char* key, std::string& target, Need need = Need::optional);
  bool read(const char* key, std::vector<std::string>& target);
  // Rows of two numbers each; `allowed` is for the message.
  bool read(const char* key, std::vector<std::array<double, 2>>& target, const std::string& allowed,
            Need need = Need::optional);
  // Whether the key holds a number, be it right or wrong.
  bool holds_number(const char* key);
  bool read(const char* key, std::vector<Vec3d>& target, const std::string& allowed);
  bool read(const char* key, std::vector<double>& target, const std::string& allowed,
            Need need = Need::optional);
  // Whether the key holds this word.
  bool says(const char* key, const std::string& word);
  bool read_integer(const char* key, int& target, int lower, int upper);

  // A string out of a list; the target becomes its index.
  bool read_choice(const char* key, int& target, const std::vector<std::string>& names,
                   Need need = Need::optional);

  CaseTable table(const char* key);
  // The entries of [[key]], or of an inline list of tables.
  std::vector<CaseTable> tables(const char* key, Need need);
  // The tables inside [key], in the order of the file.
  std::vector<std::pair<std::string, CaseTable>> named_tables(const char* key, Need need);

  bool has(const char* key) const;
  bool from_override() const { return place_.order == override_order; }
  // Whether the key is given by --set.
  bool set(const char* key) const;
  bool faulty() const { return !problems_->fine_within(path_); }
  bool is_list(const char* key) const;
  bool is_table(const char* key) const;
  // Reports the key, if it is given, as one that does not go with the others.
  void refuse(const char* key, const std::string& reason);
  const std::string& path() const { return path_; }
  std::string key_path(const std::string& key) const;
  void problem(const std::string& key, const std::string& what);
  // The keys that are given and were not asked for, and those that were.
  std::vector<std::string> unknown() const;
  const std::vector<std::string>& known() const { return known_; }
  void report_unknown(const std::string& name, const std::string& what);

 private:
  const Toml* find(const char* key, Need need, const std::string& allowed);
  bool wrong_type(const char* key, const Toml& value, const std::string& allowed);
  bool beyond_numbers(const char* key, const Toml& entry, const std::string& allowed);

  const Toml* table_;
  std::string path_;
  Place place_;
  CaseProblems* problems_;
  std::vector<std::string> known_;
};

// "did you mean 'x'? ", of what is written alike or has a part in common, or nothing.
std::string suggestion(const std::string& key, const std::vector<std::string>& known);

// "a, b, c"
std::string join(const std::vector<std::string>& names);

}  // namespace slagflow
