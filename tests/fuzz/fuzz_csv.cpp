// Readings of a viscometer, and the fits to them.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "backend/error.hpp"
#include "host/rheometry/rheometry_data.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slagflow;
  try {
    const Measurements m = parse_measurements({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const double rate : m.curve.rate)
      if (!(rate > 0)) std::abort();
    fit_all(m.curve, ErrorModel::absolute);
  } catch (const Error&) {
  }
  return 0;
}
