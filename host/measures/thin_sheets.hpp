// Fluid in sheets, threads and drops that are thinner than the method can carry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/output/summary_json.hpp"
#include "observation/totals.hpp"

namespace slagflow {

class ThinSheets {
 public:
  void look(const Totals& totals, double time);

  std::int64_t most() const { return most_; }
  double time_of_most() const { return time_of_most_; }
  void restore(std::int64_t most, double time) { most_ = most, time_of_most_ = time; }

  // For people: how many of `start` particles there were, and what follows where these were many.
  std::vector<std::string> lines(const Case& c, std::int64_t start) const;
  std::vector<std::string> warnings(const Case& c, std::int64_t start) const;
  void add_to(Json& summary) const;

 private:
  std::int64_t most_ = 0, now_ = 0;
  double time_of_most_ = 0;  // [s]
};

}  // namespace slagflow
