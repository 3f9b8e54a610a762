// Launches that come again and again, recorded once and given to a GPU as one graph. A CPU build runs them
// one by one.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "backend/context.hpp"

namespace slagflow {

class LaunchGraph {
 public:
  // The label names the graph among the timings.
  LaunchGraph(Context&, const char* label);
  ~LaunchGraph();
  LaunchGraph(const LaunchGraph&) = delete;
  LaunchGraph& operator=(const LaunchGraph&) = delete;

  // Does what `record` launches. What was recorded the last time is taken again, and `record` not called,
  // where the numbers are the same and the context's generation is; so they must be all that the launches
  // depend on besides the contents of buffers and the numbers of Rows, and `record` may change nothing else.
  // It may not take memory, wait, or copy to or from the host, other than by Context::post_to_host(): it
  // throws Error then, with nothing done.
  using Numbers = std::array<double, 4>;
  void run(const Numbers&, const std::function<void()>& record);

  // Launches one by one from now on, so that parts of `record` are timed.
  void launch_singly() { singly_ = true; }

 private:
  struct Native;
  bool record_anew(const std::function<void()>& record);

  Context& context_;
  const char* label_;
  bool holds_ = false, singly_ = false;
  Numbers numbers_{};
  std::uint64_t generation_ = 0;
  std::int64_t kernels_ = 0;
  std::unique_ptr<Native> native_;
};

}  // namespace slagflow
