// slagflow with a disk that fails: a process of its own for the tests of what a run then leaves.
// Writes to regular files are counted, and the one given by SLAGFLOW_FAIL_WRITE fails as on a full disk:
//   once N     it alone
//   always N   it and all later ones
//   torn N     it writes half of its bytes, then as always
// The functions stand before those of the C library, for this program and the libraries it loads.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "host/program/program.hpp"

namespace {

enum class Failure { none, torn, full };

std::atomic<long> writes{0};

Failure failure_of_next(int file) {
  struct stat state {};
  if (file <= STDERR_FILENO || fstat(file, &state) != 0 || !S_ISREG(state.st_mode)) return Failure::none;
  static const char* const given = std::getenv("SLAGFLOW_FAIL_WRITE");
  static const long bad = given != nullptr ? std::atol(std::strchr(given, ' ')) : 0;
  const long number = ++writes;
  if (given == nullptr || number < bad) return Failure::none;
  if (number == bad) return given[0] == 't' ? Failure::torn : Failure::full;
  return given[0] == 'o' ? Failure::none : Failure::full;
}

ssize_t full() {
  errno = ENOSPC;
  return -1;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  const Failure failure = failure_of_next(file);
  if (failure == Failure::full) return full();
  return syscall(SYS_write, file, bytes, failure == Failure::torn ? count / 2 : count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  if (failure_of_next(file) != Failure::none) return full();
  return syscall(SYS_writev, file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t place) {
  const Failure failure = failure_of_next(file);
  if (failure == Failure::full) return full();
  return syscall(SYS_pwrite64, file, bytes, failure == Failure::torn ? count / 2 : count, place);
}

int posix_fallocate(int file, off_t from, off_t count) {
  if (failure_of_next(file) != Failure::none) return ENOSPC;
  return syscall(SYS_fallocate, file, 0, from, count) == 0 ? 0 : errno;
}

}  // extern "C"

int main(int argc, char** argv) { return slagflow::run_program(argc, argv); }
