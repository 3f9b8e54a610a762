#include <nvtx3/nvToolsExt.h>

#include <cstdlib>
#include <cstring>
#include <utility>

#include "backend/check.hpp"
#include "backend/context.hpp"
#include "backend/device.hpp"

namespace slagflow {

struct Context::Native {
  struct Timer {
    cudaEvent_t start = nullptr, stop = nullptr;
    bool pending = false;
    double total = 0;
  };
  cudaStream_t stream = nullptr, loop_stream = nullptr;
  void* staging = nullptr;  // pinned memory of the host
  std::map<std::string, Timer> timers;

  // Adds the last interval of a timer, which ended about a step ago.
  static void collect(Timer& timer) {
    if (!timer.pending) return;
    float milliseconds = 0;
    check(cudaEventSynchronize(timer.stop), "event synchronise");
    check(cudaEventElapsedTime(&milliseconds, timer.start, timer.stop), "event time");
    timer.total += 1e-3 * milliseconds;
    timer.pending = false;
  }
};

// Drivers before CUDA 12.3 cannot load a kernel while its launch is recorded. The driver reads this when it
// is used first; what the user has set stays.
static void load_all_kernels_at_the_start() { setenv("CUDA_MODULE_LOADING", "EAGER", 0); }

Context::Context() : native_(std::make_unique<Native>()) {
  load_all_kernels_at_the_start();
  check(cudaStreamCreateWithFlags(&native_->stream, cudaStreamNonBlocking), "stream create");
  check(cudaStreamCreateWithFlags(&native_->loop_stream, cudaStreamNonBlocking), "stream create");
  check(cudaMallocHost(&native_->staging, posted_bytes), "pinned memory");
}

Context::~Context() {
  release(workspace_, workspace_bytes_);
  release(ticket_, ticket_bytes);
  for (auto& [label, timer] : native_->timers) {
    cudaEventDestroy(timer.start);
    cudaEventDestroy(timer.stop);
  }
  cudaFreeHost(native_->staging);
  cudaStreamDestroy(native_->loop_stream);
  cudaStreamDestroy(native_->stream);
}

void* Context::allocate(std::size_t bytes, const char* what) {
  if (bytes == 0) return nullptr;
  forbid_while_recording(what);
  void* memory = nullptr;
  const cudaError_t status = cudaMalloc(&memory, bytes);
  if (status == cudaErrorMemoryAllocation) {
    cudaGetLastError();  // clears it: the caller may go on
    throw Error("out of device memory: " + std::string(what) + " needs " + std::to_string(bytes) +
                " bytes, " + std::to_string(allocated_) + " are in use");
  }
  check(status, what);
  allocated_ += bytes;
  ++counts_.allocations;
  arrange_anew();
  return memory;
}

void Context::release(void* memory, std::size_t bytes) noexcept {
  if (!memory) return;
  cudaFree(memory);
  allocated_ -= bytes;
  arrange_anew();
}

void* Context::workspace(std::size_t bytes) {
  if (bytes > workspace_bytes_) {
    synchronize();
    const std::size_t quarter_more = workspace_bytes_ + workspace_bytes_ / 4;
    const std::size_t wanted = bytes > quarter_more ? bytes : quarter_more;
    release(workspace_, workspace_bytes_);
    workspace_ = nullptr, workspace_bytes_ = 0;
    workspace_ = allocate(wanted, "workspace");
    workspace_bytes_ = wanted;
  }
  return workspace_;
}

void* Context::ticket() {
  if (!ticket_) {
    ticket_ = allocate(ticket_bytes, "ticket");
    check(cudaMemsetAsync(ticket_, 0, ticket_bytes, native_->stream), "clear");
  }
  return ticket_;
}

void Context::copy_to_device(void* device, const void* host, std::size_t bytes) {
  if (!bytes) return;
  forbid_while_recording("copy to device");
  check(cudaMemcpyAsync(device, host, bytes, cudaMemcpyHostToDevice, native_->stream), "copy to device");
  synchronize();
}

void Context::copy_to_host(void* host, const void* device, std::size_t bytes) {
  if (!bytes) return;
  if (bytes <= posted_bytes) {  // pageable memory would be copied twice, and slowly
    post_to_host(device, bytes);
    read_posted(host, bytes);
    return;
  }
  forbid_while_recording("copy to host");
  check(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, native_->stream), "copy to host");
  synchronize();
}

void Context::post_to_host(const void* device, std::size_t bytes) {
  check(cudaMemcpyAsync(native_->staging, device, bytes, cudaMemcpyDeviceToHost, native_->stream),
        "copy to host");
}

void Context::read_posted(void* host, std::size_t bytes) {
  synchronize();
  std::memcpy(host, native_->staging, bytes);
}

void Context::copy_on_device(void* to, const void* from, std::size_t bytes) {
  if (!bytes) return;
  check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, native_->stream), "copy on device");
}

void Context::synchronize() {
  forbid_while_recording("wait for the device");
  ++counts_.waits;
  check(cudaStreamSynchronize(native_->stream), "synchronise");
}

// These end a recording, or worse; they have their place before it.
void Context::forbid_while_recording(const char* what) const {
  if (recording_) throw Error(std::string("CUDA: ") + what + ": not possible while launches are recorded");
}

void Context::repeat_while(const std::int32_t* flag, const std::function<void()>& body) {
  if (recording_) return record_loop(flag, body);
  for (;;) {
    std::int32_t now = 0;
    copy_to_host(&now, flag, sizeof now);
    if (!goes_on(&now)) return;
    body();
  }
}

void Context::swap_streams() { std::swap(native_->stream, native_->loop_stream); }

void Context::begin(const char* label) {
  nvtxRangePushA(label);
  if (recording_) return;
  auto& timer = native_->timers[label];
  if (!timer.start) {
    check(cudaEventCreate(&timer.start), "event create");
    check(cudaEventCreate(&timer.stop), "event create");
  }
  Native::collect(timer);
  check(cudaEventRecord(timer.start, native_->stream), "event record");
}

void Context::end(const char* label) {
  nvtxRangePop();
  if (recording_) return;
  auto& timer = native_->timers[label];
  // A failed launch has been or will be reported by its own check; a destructor must not throw.
  timer.pending = cudaEventRecord(timer.stop, native_->stream) == cudaSuccess;
}

std::map<std::string, double> Context::timings() {
  std::map<std::string, double> result;
  for (auto& [label, timer] : native_->timers) {
    Native::collect(timer);
    result[label] = timer.total;
  }
  return result;
}

void* Context::stream() const { return native_->stream; }

DeviceInfo device_info() {
  load_all_kernels_at_the_start();
  int device = 0;
  cudaDeviceProp properties{};
  check(cudaGetDevice(&device), "no usable GPU");
  check(cudaGetDeviceProperties(&properties, device), "device properties");
  std::size_t available = 0, all = 0;
  check(cudaMemGetInfo(&available, &all), "device memory");
  return {"cuda", properties.name, 1, static_cast<double>(available)};
}

std::string missing_for_loops() {
  int driver = 0;
  check(cudaDriverGetVersion(&driver), "version of the driver");
  return missing_for_loops(CUDART_VERSION, driver);
}

void use_device_of_rank(int local_rank) {
  load_all_kernels_at_the_start();
  int devices = 0;
  check(cudaGetDeviceCount(&devices), "no usable GPU");
  check(cudaSetDevice(device_of_rank(local_rank, devices)), "the rank's GPU");
}

void set_threads(int) {}

}  // namespace slagflow
