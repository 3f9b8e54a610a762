// A CPU build copies at once: its device memory is the host's, and nothing else would do it.
#include "backend/side_copy.hpp"

namespace slagflow {

struct SideStream::Native {};
struct SideCopy::Native {
  std::vector<std::unique_ptr<char[]>> parts;
};

SideStream::SideStream(Context& context) : context_(context) {}
SideStream::~SideStream() = default;

SideCopy::SideCopy() : native_(std::make_unique<Native>()) {}
SideCopy::~SideCopy() = default;

void SideCopy::start(SideStream& side, const std::vector<Part>& parts) {
  forget();
  for (const Part& part : parts) {
    native_->parts.emplace_back(new char[part.bytes]);
    side.context_.copy_on_device(native_->parts.back().get(), part.device, part.bytes);
  }
}

void SideCopy::wait() {}
const void* SideCopy::part(std::size_t number) const { return native_->parts[number].get(); }
void SideCopy::forget() { native_->parts.clear(); }

}  // namespace slagflow
