// Scratch of sums over particles.
#pragma once

#include "backend/buffer.hpp"

namespace slagflow {

struct DiagnosticScratch {
  static constexpr int most_terms = 4;
  explicit DiagnosticScratch(Context& c) : result(c, "diagnostic sums", most_terms) {}
  Buffer<double> result;
};

}  // namespace slagflow
