// Readings of a viscometer, and the fits to one in thirty-two of them, which take a hundred times as long.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_data.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slagflow;
  try {
    const Measurements m = parse_measurements({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const double rate : m.curve.rate)
      if (!(rate > 0)) std::abort();
    if (std::accumulate(data, data + size, 0U) % 32 == 0) fit_all(m.curve, ErrorModel::absolute);
  } catch (const Error&) {
  }
  return 0;
}
