// What is measured of the fluid during a run: one object for each [[measure]] of the case.
//
// A new kind of measure is a class here or in a file of its own, an entry of MeasureType and of
// make_measure() in measures.cpp, and its keys in the case file.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// What a measure sees at a line of the history.
struct MeasureMoment {
  double time;  // [s]
  const Totals& totals;
  // A snapshot is read only where a measure asks for one.
  const std::function<const FluidSnapshot&()>& read;
};

class Measure {
 public:
  explicit Measure(std::string name) : name_(std::move(name)) {}
  virtual ~Measure() = default;

  const std::string& name() const { return name_; }
  // Endings of the history's columns, units included, and their values now; unknown values are not-a-number.
  virtual std::vector<std::string> columns() const = 0;
  virtual std::vector<double> update(const MeasureMoment&) = 0;

  // What it has seen so far, as the same number of values at all times, and back: a measure of the same case
  // goes on as this one would.
  virtual std::vector<double> state() const = 0;
  virtual void restore(const double* state) = 0;

  // Whether what it waits for has come.
  virtual bool arrived() const { return false; }

  virtual Json summary() const = 0;      // {type, ...}
  virtual std::string line() const = 0;  // for people
  virtual const char* type() const = 0;  // as in a case file

 private:
  std::string name_;
};

// All measures of a case.
class Measures {
 public:
  // `setup`: as it was built from the case, with the particles of the start.
  Measures(const Case&, const SimulationSetup& setup);

  // NAME_ENDING for each column of each measure.
  std::vector<std::string> columns() const;

  // The values of the columns now.
  using ReadSnapshot = std::function<const FluidSnapshot&()>;
  std::vector<double> update(double time, const Totals& totals, const ReadSnapshot& read);

  // What they have seen so far, and back: measures of the same case go on as these would.
  // Throws Error when the state is one of other measures.
  std::vector<double> state() const;
  void restore(const std::vector<double>& state);

  // Whether the measure of this name has arrived.
  bool arrived(const std::string& name) const;

  // Name of each measure -> {type, ...}.
  Json summary() const;
  // For people: a line for each measure.
  std::vector<std::string> lines() const;

 private:
  std::vector<std::unique_ptr<Measure>> measures_;
};

}  // namespace slagflow
