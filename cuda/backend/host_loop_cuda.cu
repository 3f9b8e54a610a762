#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "backend/host_loop.hpp"

namespace slagflow {

void for_each_part(std::size_t count, const std::function<void(std::size_t)>& part) {
  FirstFailure failure;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < count; k = next++) failure.run(part, k);
  };
  std::vector<std::thread> others;
  const std::size_t wanted = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
  try {
    while (others.size() + 1 < wanted) others.emplace_back(work);
  } catch (const std::system_error&) {  // fewer threads will do
  }
  work();
  for (std::thread& other : others) other.join();
  failure.rethrow();
}

}  // namespace slagflow
