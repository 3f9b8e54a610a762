#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>

#include "backend/context.hpp"
#include "backend/device.hpp"
#include "backend/error.hpp"
#include "backend/launch_graph.hpp"

namespace slagflow {

using Clock = std::chrono::steady_clock;

struct Context::Native {
  struct Timer {
    Clock::time_point started;
    double total = 0;
  };
  std::map<std::string, Timer> timers;
  char posted[posted_bytes];
};

Context::Context() : native_(std::make_unique<Native>()) {}

Context::~Context() { release(workspace_, workspace_bytes_); }

void* Context::allocate(std::size_t bytes, const char* what) {
  if (bytes == 0) return nullptr;
  constexpr std::size_t line = 64, beyond = 256;  // whole registers may be read across the end
  void* memory = bytes > std::size_t(1) << 48
                     ? nullptr
                     : std::aligned_alloc(line, (bytes + beyond + line - 1) / line * line);
  if (!memory)
    throw LocalError("out of memory: " + std::string(what) + " needs " + std::to_string(bytes) + " bytes, " +
                     std::to_string(allocated_) + " are in use");
  allocated_ += bytes;
  ++counts_.allocations;
  arrange_anew();
  return memory;
}

void Context::release(void* memory, std::size_t bytes) noexcept {
  if (!memory) return;
  std::free(memory);
  allocated_ -= bytes;
  arrange_anew();
}

void* Context::workspace(std::size_t bytes) {
  if (bytes > workspace_bytes_) {
    const std::size_t quarter_more = workspace_bytes_ + workspace_bytes_ / 4;
    const std::size_t wanted = bytes > quarter_more ? bytes : quarter_more;
    release(workspace_, workspace_bytes_);
    workspace_ = nullptr, workspace_bytes_ = 0;
    workspace_ = allocate(wanted, "workspace");
    workspace_bytes_ = wanted;
  }
  return workspace_;
}

void* Context::ticket() { return ticket_; }  // none is needed

void Context::copy_to_device(void* device, const void* host, std::size_t bytes) {
  if (bytes) std::memcpy(device, host, bytes);
}
void Context::copy_to_host(void* host, const void* device, std::size_t bytes) {
  if (bytes) std::memcpy(host, device, bytes), ++counts_.waits;
}
void Context::post_to_host(const void* device, std::size_t bytes) {
  std::memcpy(native_->posted, device, bytes);
}
void Context::read_posted(void* host, std::size_t bytes) { copy_to_host(host, native_->posted, bytes); }
void Context::copy_on_device(void* to, const void* from, std::size_t bytes) {
  constexpr std::size_t piece = 1 << 18;  // bytes that one thread copies at a time
#pragma omp parallel for schedule(static) if (bytes > piece)
  for (std::size_t at = 0; at < bytes; at += piece)
    std::memcpy(static_cast<char*>(to) + at, static_cast<const char*>(from) + at,
                std::min(piece, bytes - at));
}
void Context::synchronize() {}

void Context::repeat_while(const std::int32_t* flag, const std::function<void()>& body) {
  while (goes_on(flag)) body();
}

void Context::begin(const char* label) { native_->timers[label].started = Clock::now(); }

void Context::end(const char* label) {
  auto& timer = native_->timers[label];
  timer.total += std::chrono::duration<double>(Clock::now() - timer.started).count();
}

std::map<std::string, double> Context::timings() {
  std::map<std::string, double> result;
  for (const auto& [label, timer] : native_->timers) result[label] = timer.total;
  return result;
}

void* Context::stream() const { return nullptr; }

struct LaunchGraph::Native {};

LaunchGraph::LaunchGraph(Context& context, const char* label) : context_(context), label_(label) {}
LaunchGraph::~LaunchGraph() = default;
void LaunchGraph::run(const Numbers&, const std::function<void()>& record) { record(); }

DeviceInfo device_info() {
  DeviceInfo info{"cpu", "unknown processor", omp_get_max_threads(), 0};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) {
      info.name = line.substr(line.find(':') + 2);
      break;
    }
  return info;
}

std::string missing_for_loops() { return {}; }

void use_device_of_rank(int) {}

void set_threads(int count) { omp_set_num_threads(count); }

}  // namespace slagflow
