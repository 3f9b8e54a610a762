// The execution context: one stream, one workspace, memory accounting, counts and timers by label.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "backend/device.hpp"
#include "backend/platform.hpp"

namespace slagflow {

// Whether a loop that is steered by a number in memory takes another turn.
HOST_DEVICE inline bool goes_on(const std::int32_t* flag) { return *flag != 0; }

class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Device memory; throws Error naming `what` and the size when there is not enough.
  void* allocate(std::size_t bytes, const char* what);
  void release(void* memory, std::size_t bytes) noexcept;
  std::size_t allocated() const { return allocated_; }

  // Scratch memory kept between calls; valid until the next call. Grows by a quarter at least.
  void* workspace(std::size_t bytes);

  // For the back end: a number on the device that is zero between launches, and room for a result behind it.
  void* ticket();
  static constexpr std::size_t ticket_bytes = 16, result_at = 8;

  void copy_to_device(void* device, const void* host, std::size_t bytes);
  void copy_to_host(void* host, const void* device, std::size_t bytes);
  void copy_on_device(void* to, const void* from, std::size_t bytes);
  void synchronize();
  // The same as copy_to_host() in two parts, so that the first can be recorded: at most posted_bytes, with no
  // other copy to the host in between.
  static constexpr std::size_t posted_bytes = 1024;
  void post_to_host(const void* device, std::size_t bytes);
  void read_posted(void* host, std::size_t bytes);

  // Does what `body` launches again and again while the number on the device is not zero, and looks at it
  // before each time. The device does so where launches are recorded for a graph: `body` may then launch
  // kernels and copy on the device only. Otherwise the host does, and waits for each look.
  void repeat_while(const std::int32_t* flag, const std::function<void()>& body);

  const DeviceCounts& counts() const { return counts_; }
  bool recording() const { return recording_; }
  void count_launch() { ++(recording_ ? recorded_launches_ : counts_.launches); }

  // Changes whenever memory is taken or given back, buffers change places, or arrange_anew() tells that other
  // launches are needed. The size of a buffer that stays within its memory is no part of it: what is recorded
  // takes the number of its elements from Rows, or from what never changes.
  std::uint64_t generation() const { return generation_; }
  void arrange_anew() { ++generation_; }

  // Timers; on CUDA they are events on the stream and NVTX ranges, and cost no synchronisation. What is
  // recorded for a graph is not timed.
  void begin(const char* label);
  void end(const char* label);
  std::map<std::string, double> timings();  // [s] by label

  void* stream() const;  // the back end's own stream handle

 private:
  friend class LaunchGraph;
  void forbid_while_recording(const char* what) const;
  void record_loop(const std::int32_t* flag, const std::function<void()>& body);
  void swap_streams();  // launches go to the other stream: the body of a loop is recorded on one of its own

  struct Native;
  std::unique_ptr<Native> native_;
  std::size_t allocated_ = 0;
  DeviceCounts counts_;
  bool recording_ = false, recorded_loop_ = false;
  std::int64_t recorded_launches_ = 0;
  std::uint64_t generation_ = 0;
  void* workspace_ = nullptr;
  std::size_t workspace_bytes_ = 0;
  void* ticket_ = nullptr;
};

// Times a scope under a label.
class Section {
 public:
  Section(Context& context, const char* label) : context_(context), label_(label) { context_.begin(label_); }
  ~Section() { context_.end(label_); }
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;

 private:
  Context& context_;
  const char* label_;
};

}  // namespace slagflow
