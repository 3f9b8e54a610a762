// A build without MPI: one rank.
#include <cstdlib>
#include <cstring>

#include "backend/error.hpp"
#include "backend/ranks.hpp"

namespace slagflow {

Ranks& Ranks::world() {
  static Ranks ranks;
  return ranks;
}

void Ranks::start(int&, char**&) {
  if (launched_with_others())
    throw InputError(
        "this program was built without MPI, and cannot share a run with the others that were "
        "started: build with a preset of MPI, as cpu-mpi");
}
void Ranks::end() {}
void Ranks::abort(int exit_code, const std::string&) { std::_Exit(exit_code); }
bool Ranks::built_in() { return false; }

void Ranks::exchange(const std::vector<Message>&) {}
void Ranks::add(std::int64_t*, std::size_t) {}
void Ranks::take_largest(double*, std::size_t) {}
void Ranks::join(void*, std::size_t) {}
void Ranks::share(void*, std::size_t) {}

std::vector<std::byte> Ranks::gathered(const void* own, std::size_t bytes) {
  std::vector<std::byte> all(bytes);
  if (bytes > 0) std::memcpy(all.data(), own, bytes);
  return all;
}
std::vector<std::byte> Ranks::gathered(const void* own, const std::vector<std::size_t>& bytes) {
  return gathered(own, bytes.front());
}
std::vector<std::byte> Ranks::gathered_on_first(const void* own, std::size_t bytes) {
  return gathered(own, bytes);
}
std::vector<std::vector<std::byte>> Ranks::dealt(const std::vector<std::vector<std::byte>>& send) {
  return send;
}

}  // namespace slagflow
