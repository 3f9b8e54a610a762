// Scratch of sums over particles, and sums that are waited for together.
#pragma once

#include <functional>
#include <vector>

#include "backend/buffer.hpp"

namespace slagflow {

struct DiagnosticScratch {
  static constexpr int room = 512;
  explicit DiagnosticScratch(Context& c) : result(c, "diagnostic sums", room) {}
  Buffer<double> result;
};

// What is launched one after the other and copied to the host at once. One at a time uses the scratch.
class GatheredSums {
 public:
  using Use = std::function<void(const double*)>;  // what becomes of the numbers on the host

  GatheredSums(Context& c, DiagnosticScratch& scratch) : context(c), scratch_(scratch) {}

  // Places on the device for so many numbers. When there are too few read() comes first.
  double* place(int count, Use use) {
    make_room(count);
    double* const at = scratch_.result.span().data + taken_;
    uses_.push_back({taken_, std::move(use)});
    taken_ += count;
    return at;
  }
  // So many that follow are gathered without a read() in between.
  void make_room(int count) {
    if (taken_ + count > DiagnosticScratch::room) read();
  }

  // Waits for all that have been launched, and hands them out in the order of their launches.
  void read() {
    double values[DiagnosticScratch::room];
    context.copy_to_host(values, scratch_.result.span().data,
                         static_cast<std::size_t>(taken_) * sizeof *values);
    for (const Gathered& g : uses_) g.use(values + g.at);
    uses_.clear(), taken_ = 0;
  }

  Context& context;

 private:
  struct Gathered {
    int at;
    Use use;
  };
  DiagnosticScratch& scratch_;
  std::vector<Gathered> uses_;
  int taken_ = 0;
};

}  // namespace slagflow
