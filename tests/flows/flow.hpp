// Runs a case file to a time and looks at the result.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "host/geometry/setup_builder.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

inline constexpr double g = 9.81;  // [m/s^2]

class Flow {
 public:
  explicit Flow(const std::string& case_file, const std::vector<std::string>& overrides = {})
      : built_(build_setup(load_case(SLAGFLOW_SOURCE_DIR "/cases/" + case_file, overrides))),
        simulation_(built_.setup) {}

  // Steps until `time` [s] or until `stop` says so, which it is asked every `every` steps.
  void run(double time, const std::function<bool()>& stop = nullptr, int every = 5) {
    while (simulation_.time() < time) {
      simulation_.step();
      if (stop && simulation_.steps() % every == 0 && stop()) return;
    }
  }

  FluidSnapshot snapshot() {
    FluidSnapshot result;
    simulation_.read(result);
    return result;
  }

  Simulation& simulation() { return simulation_; }
  const SimulationSetup& setup() const { return built_.setup; }
  const Case& resolved() const { return built_.resolved; }

 private:
  BuiltCase built_;
  Simulation simulation_;
};

inline double rms_speed(const FluidSnapshot& s) {
  double sum = 0;
  for (const auto& v : s.velocity)
    sum += double(v.x) * double(v.x) + double(v.y) * double(v.y) + double(v.z) * double(v.z);
  return std::sqrt(sum / static_cast<double>(s.velocity.size()));
}

}  // namespace slagflow
