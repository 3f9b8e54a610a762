// Copies from the device to the host that go on beside what the stream of a context does.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "backend/context.hpp"

namespace slagflow {

// What has to be on the device for it: a second stream, and memory for one copy of the data, so that the
// originals may change. A CPU build needs neither. Must outlive its copies.
class SideStream {
 public:
  explicit SideStream(Context&);
  ~SideStream();
  SideStream(const SideStream&) = delete;
  SideStream& operator=(const SideStream&) = delete;

 private:
  friend class SideCopy;
  struct Native;
  Context& context_;
  std::unique_ptr<Native> native_;
};

// One copy under way, and the host's memory for it.
class SideCopy {
 public:
  SideCopy();
  ~SideCopy();
  SideCopy(const SideCopy&) = delete;
  SideCopy& operator=(const SideCopy&) = delete;

  struct Part {
    const void* device;
    std::size_t bytes;
  };
  // Copies the parts as all that was launched before leaves them, and does not wait for it. With no copy of
  // this object under way. Throws Error when memory ends.
  void start(SideStream&, const std::vector<Part>& parts);

  // Waits until the parts have arrived; from any thread. Throws Error when the device has failed.
  void wait();
  // The part of that number, until the next start() or forget(); aligned for any number.
  const void* part(std::size_t number) const;
  // Gives back the memory that can be had again at no cost.
  void forget();

 private:
  struct Native;
  std::unique_ptr<Native> native_;
};

}  // namespace slagflow
