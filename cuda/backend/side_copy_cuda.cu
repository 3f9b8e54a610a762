#include "backend/check.hpp"
#include "backend/side_copy.hpp"

namespace slagflow {

namespace {

constexpr std::size_t alignment = 256;

std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

cudaEvent_t new_event(unsigned also = 0) {
  cudaEvent_t event = nullptr;
  check(cudaEventCreateWithFlags(&event, cudaEventDisableTiming | also), "event create");
  return event;
}

char* pinned_memory(std::size_t bytes) {
  void* memory = nullptr;
  const cudaError_t status = cudaMallocHost(&memory, bytes);
  if (status == cudaErrorMemoryAllocation) {
    cudaGetLastError();  // clears it: the caller may go on
    throw Error("out of pinned memory of the host: a copy from the device needs " + std::to_string(bytes) +
                " bytes");
  }
  check(status, "pinned memory");
  return static_cast<char*>(memory);
}

}  // namespace

struct SideStream::Native {
  cudaStream_t stream = nullptr;
  cudaEvent_t gathered = nullptr, emptied = nullptr;  // the parts are in `staging`; they have left it
  void* staging = nullptr;
  std::size_t bytes = 0;
};

struct SideCopy::Native {
  cudaEvent_t arrived = nullptr;
  char* host = nullptr;  // pinned
  std::size_t bytes = 0;
  std::vector<std::size_t> start;
};

SideStream::SideStream(Context& context) : context_(context), native_(std::make_unique<Native>()) {
  check(cudaStreamCreateWithFlags(&native_->stream, cudaStreamNonBlocking), "stream create");
  native_->gathered = new_event(), native_->emptied = new_event();
}

SideStream::~SideStream() {
  cudaStreamSynchronize(native_->stream);
  context_.release(native_->staging, native_->bytes);
  cudaEventDestroy(native_->gathered);
  cudaEventDestroy(native_->emptied);
  cudaStreamDestroy(native_->stream);
}

SideCopy::SideCopy() : native_(std::make_unique<Native>()) {}

SideCopy::~SideCopy() {
  if (!native_->arrived) return;
  cudaEventSynchronize(native_->arrived);
  cudaEventDestroy(native_->arrived);
  cudaFreeHost(native_->host);
}

void SideCopy::start(SideStream& side, const std::vector<Part>& parts) {
  auto& [stream, gathered, emptied, staging, held] = *side.native_;
  if (!native_->arrived) native_->arrived = new_event(cudaEventBlockingSync);  // a thread waits, idle
  std::size_t bytes = 0;
  native_->start.clear();
  for (const Part& part : parts) {
    native_->start.push_back(bytes);
    bytes += aligned(part.bytes);
  }
  if (bytes > held) {
    check(cudaStreamSynchronize(stream), "synchronise");
    side.context_.release(staging, held);
    staging = nullptr, held = 0;
    staging = side.context_.allocate(bytes, "the copy that a snapshot is read from");
    held = bytes;
  }
  if (bytes > native_->bytes) {
    cudaFreeHost(native_->host);
    native_->host = nullptr, native_->bytes = 0;
    native_->host = pinned_memory(bytes);
    native_->bytes = bytes;
  }
  // The step behind this waits on the device until the last copy has left, and for its own copy there; the
  // way to the host is the other stream's.
  const auto main = static_cast<cudaStream_t>(side.context_.stream());
  check(cudaStreamWaitEvent(main, emptied, 0), "wait for event");
  for (std::size_t k = 0; k < parts.size(); ++k)
    side.context_.copy_on_device(static_cast<char*>(staging) + native_->start[k], parts[k].device,
                                 parts[k].bytes);
  check(cudaEventRecord(gathered, main), "event record");
  check(cudaStreamWaitEvent(stream, gathered, 0), "wait for event");
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].bytes > 0)
      check(cudaMemcpyAsync(native_->host + native_->start[k],
                            static_cast<const char*>(staging) + native_->start[k], parts[k].bytes,
                            cudaMemcpyDeviceToHost, stream),
            "copy to host");
  check(cudaEventRecord(emptied, stream), "event record");
  check(cudaEventRecord(native_->arrived, stream), "event record");
}

void SideCopy::wait() { check(cudaEventSynchronize(native_->arrived), "event synchronise"); }
const void* SideCopy::part(std::size_t number) const { return native_->host + native_->start[number]; }
void SideCopy::forget() {}  // pinned memory is slow to take

}  // namespace slagflow
