// A loop of the host over parts of its own work, such as the rows of a lattice: OpenMP's threads in a CPU
// build, the system's in a CUDA build.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace slagflow {

// Calls part(k) once for each k in [0, count), in any order and several at a time. A part writes only what is
// its own. All are called; then throws what the first of the parts that failed has thrown.
void for_each_part(std::size_t count, const std::function<void(std::size_t)>& part);

// Calls part(first, last) for ranges that together are [0, count), each `grain` long but the last.
template <class Part>
void for_each_range(std::size_t count, std::size_t grain, const Part& part) {
  for_each_part((count + grain - 1) / grain,
                [&](std::size_t k) { part(k * grain, (k + 1) * grain < count ? (k + 1) * grain : count); });
}

// What the first of several parts has thrown.
class FirstFailure {
 public:
  void run(const std::function<void(std::size_t)>& part, std::size_t k) noexcept {
    try {
      part(k);
    } catch (...) {
      const std::lock_guard<std::mutex> guard(mutex_);
      if (!failure_ || k < part_) failure_ = std::current_exception(), part_ = k;
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t part_ = 0;
};

}  // namespace slagflow
