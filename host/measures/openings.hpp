// What is told of inlets and outlets.
#pragma once

#include <string>
#include <vector>

#include "host/output/summary_json.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

class Openings {
 public:
  // `setup`: as it was built from the case.
  explicit Openings(const SimulationSetup& setup);

  // Of the history, and their values now: mass that has come in [kg] and gone out, of each. None without any.
  std::vector<std::string> columns() const;
  std::vector<double> values(const Totals&) const;

  std::vector<std::string> lines(const Totals&) const;
  void add_to(Json& summary, const Totals&) const;

  // Whether an inlet still brings fluid after a time [s].
  bool feeds_after(double time) const;

 private:
  std::vector<InletSetup> inlets_;
  std::vector<OutletSetup> outlets_;
};

}  // namespace slagflow
