// What is told of heat.
#pragma once

#include <string>
#include <vector>

#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

class HeatReport {
 public:
  // `setup`: as it was built from the case. Where heat is off, nothing is told.
  explicit HeatReport(const SimulationSetup& setup);

  // Of the history, and their values now [J, K]; with two dimensions J of a metre of width.
  std::vector<std::string> columns() const;
  std::vector<double> values(const Totals&) const;

  std::vector<std::string> lines(const Totals&) const;
  void add_to(Json& summary, const Totals&) const;

 private:
  bool on_;
  std::vector<std::string> walls_;    // of each body
  std::vector<std::size_t> passing_;  // bodies that heat passes
};

}  // namespace slagflow
