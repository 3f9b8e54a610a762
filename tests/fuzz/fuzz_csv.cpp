// Readings of a viscometer, tables of phases, and the fits to one in thirty-two of them, which take a hundred
// times as long.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_data.hpp"
#include "host/rheometry/rheometry_freezing.hpp"

namespace {

void read_phases(const std::string& text) {
  using namespace slagflow;
  try {
    const PhaseTable table = parse_phases(text, "fuzz.csv", {}, 0.1);
    std::vector<std::string> warnings;
    const Freezing freezing = freezing_of(table, "fuzz.csv", warnings);
    if (freezing.solids.front()[1] != 1 || freezing.solids.back()[1] != 0) std::abort();
    heat_of(table, freezing.solids, "fuzz.csv", warnings);
  } catch (const Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slagflow;
  read_phases({reinterpret_cast<const char*>(data), size});
  try {
    const Measurements m = parse_measurements({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const double rate : m.curve.rate)
      if (!(rate > 0)) std::abort();
    if (std::accumulate(data, data + size, 0U) % 32 != 0) return 0;
    fit_all(m.curve, ErrorModel::absolute);
    find_kink(m.series, fit_all(m.series));
  } catch (const Error&) {
  }
  return 0;
}
