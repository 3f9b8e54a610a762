// Sums of heat that stay on the device. A header for .cu files.
#pragma once

#include "backend/reduce.hpp"

namespace slagflow {

enum HeatSum { heat_by_surface, heat_by_friction, heat_sums };

struct HeatTerm {
  static constexpr int terms = 1;
  Span<const double> heat;  // [J] of each particle
  HOST_DEVICE Terms<1> operator()(Index i) const { return {{heat[i]}}; }
};

struct AddHeat {
  double* sum;
  HOST_DEVICE void operator()(const Terms<1>& all) const { *sum += all.value[0]; }
};

}  // namespace slagflow
