#include "backend/host_loop.hpp"

namespace slagflow {

void for_each_part(std::size_t count, const std::function<void(std::size_t)>& part) {
  FirstFailure failure;
#pragma omp parallel for schedule(dynamic, 1) if (count > 1)
  for (std::size_t k = 0; k < count; ++k) failure.run(part, k);
  failure.rethrow();
}

}  // namespace slagflow
