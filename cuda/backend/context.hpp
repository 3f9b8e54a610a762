// The execution context: one stream, one workspace, memory accounting and timers by label.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace slagflow {

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

  // Scratch memory kept between calls; valid until the next call.
  void* workspace(std::size_t bytes);

  // For the back end: a number on the device that is zero between launches, and room for a result behind it.
  void* ticket();
  static constexpr std::size_t ticket_bytes = 16, result_at = 8;

  void copy_to_device(void* device, const void* host, std::size_t bytes);
  void copy_to_host(void* host, const void* device, std::size_t bytes);
  void copy_on_device(void* to, const void* from, std::size_t bytes);
  void synchronize();
  // How often the host has waited for the device; copies to the host count on a CPU, too.
  std::int64_t waits() const { return waits_; }

  // Timers; on CUDA they are events on the stream and NVTX ranges, and cost no synchronisation.
  void begin(const char* label);
  void end(const char* label);
  std::map<std::string, double> timings();  // [s] by label

  void* stream() const;  // the back end's own stream handle

 private:
  struct Native;
  std::unique_ptr<Native> native_;
  std::size_t allocated_ = 0;
  std::int64_t waits_ = 0;
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
