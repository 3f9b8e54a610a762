// The same by MPI. Counts of bytes go in pieces where they exceed what MPI's ints hold.
#include <fcntl.h>
// Without the C++ bindings of old, which need a library of their own.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

#include "backend/error.hpp"
#include "backend/ranks.hpp"

namespace slagflow {

namespace {

constexpr std::size_t piece = std::size_t(1) << 30;  // bytes of a message at most

// Adds the time that a call takes to `waiting`.
class Waiting {
 public:
  explicit Waiting(RankCounts& counts) : counts_(counts), begun_(Clock::now()) {}
  ~Waiting() { counts_.waiting += std::chrono::duration<double>(Clock::now() - begun_).count(); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  RankCounts& counts_;
  Clock::time_point begun_;
};

int as_int(std::size_t bytes) { return static_cast<int>(bytes); }

void send_in_pieces(const std::byte* data, std::size_t bytes, int rank, int tag,
                    std::vector<MPI_Request>& open) {
  for (std::size_t at = 0; at < bytes; at += piece) {
    open.emplace_back();
    MPI_Isend(data + at, as_int(std::min(piece, bytes - at)), MPI_BYTE, rank, tag, MPI_COMM_WORLD,
              &open.back());
  }
}

void receive_in_pieces(std::byte* data, std::size_t bytes, int rank, int tag,
                       std::vector<MPI_Request>& open) {
  for (std::size_t at = 0; at < bytes; at += piece) {
    open.emplace_back();
    MPI_Irecv(data + at, as_int(std::min(piece, bytes - at)), MPI_BYTE, rank, tag, MPI_COMM_WORLD,
              &open.back());
  }
}

void wait_for(std::vector<MPI_Request>& open) {
  MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
}

}  // namespace

Ranks& Ranks::world() {
  static Ranks ranks;
  return ranks;
}

bool Ranks::built_in() { return true; }

void Ranks::start(int& argc, char**& argv) {
  if (!launched_with_others()) return;
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_), MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
  MPI_Comm_rank(here, &local_rank_);
  MPI_Comm_free(&here);
  started_ = true;
  if (first() || std::getenv("SLAGFLOW_ALL_RANKS_SPEAK") != nullptr) return;
  stderr_ = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

void Ranks::end() {
  if (started_) MPI_Finalize();
  started_ = false, rank_ = 0, size_ = 1;
}

void Ranks::abort(int exit_code, const std::string& reason) {
  dprintf(stderr_, "error: rank %d: %s\n", rank_, reason.c_str());
  if (started_) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

void Ranks::exchange(const std::vector<Message>& messages) {
  if (!several()) return;
  const Waiting timer(counts);
  std::vector<MPI_Request> open;
  for (const Message& m : messages)
    if (m.rank >= 0) receive_in_pieces(m.receive, m.receive_bytes, m.rank, m.receive_tag, open);
  for (const Message& m : messages) {
    if (m.rank < 0) continue;
    send_in_pieces(m.send, m.send_bytes, m.rank, m.send_tag, open);
    ++counts.messages, counts.bytes += static_cast<std::int64_t>(m.send_bytes);
  }
  wait_for(open);
  ++counts.exchanges;
}

void Ranks::add(std::int64_t* values, std::size_t count) {
  if (!several()) return;
  const Waiting timer(counts);
  MPI_Allreduce(MPI_IN_PLACE, values, as_int(count), MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  ++counts.reductions;
}

// MPI's maximum of a not-a-number is not defined: whether there is one goes beside it.
void Ranks::take_largest(double* values, std::size_t count) {
  if (!several()) return;
  const Waiting timer(counts);
  std::vector<double> all(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const bool unknown = std::isnan(values[k]);
    all[k] = unknown ? -std::numeric_limits<double>::infinity() : values[k];
    all[count + k] = unknown ? 1 : 0;
  }
  MPI_Allreduce(MPI_IN_PLACE, all.data(), as_int(all.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = all[count + k] > 0 ? std::numeric_limits<double>::quiet_NaN() : all[k];
  ++counts.reductions;
}

void Ranks::join(void* bytes, std::size_t count) {
  if (!several()) return;
  const Waiting timer(counts);
  auto* at = static_cast<std::byte*>(bytes);
  for (std::size_t done = 0; done < count; done += piece)
    MPI_Allreduce(MPI_IN_PLACE, at + done, as_int(std::min(piece, count - done)), MPI_BYTE, MPI_BOR,
                  MPI_COMM_WORLD);
  ++counts.reductions;
}

void Ranks::share(void* bytes, std::size_t count) {
  if (!several()) return;
  const Waiting timer(counts);
  auto* at = static_cast<std::byte*>(bytes);
  for (std::size_t done = 0; done < count; done += piece)
    MPI_Bcast(at + done, as_int(std::min(piece, count - done)), MPI_BYTE, 0, MPI_COMM_WORLD);
  ++counts.reductions;
}

std::vector<std::size_t> Ranks::sizes_of_all(std::size_t own) {
  std::vector<std::uint64_t> all(static_cast<std::size_t>(size_));
  const std::uint64_t mine = own;
  MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  return {all.begin(), all.end()};
}

std::vector<std::byte> Ranks::gathered(const void* own, const std::vector<std::size_t>& bytes) {
  const auto* from = static_cast<const std::byte*>(own);
  if (!several()) return {from, from + bytes.front()};
  const Waiting timer(counts);
  const std::size_t all = std::accumulate(bytes.begin(), bytes.end(), std::size_t(0));
  std::vector<std::byte> result(all);
  ++counts.reductions;
  if (all < piece) {
    std::vector<int> count, first;
    int at = 0;
    for (const std::size_t b : bytes) count.push_back(as_int(b)), first.push_back(at), at += as_int(b);
    MPI_Allgatherv(own, count[static_cast<std::size_t>(rank_)], MPI_BYTE, result.data(), count.data(),
                   first.data(), MPI_BYTE, MPI_COMM_WORLD);
    return result;
  }
  std::size_t first = 0;
  for (int r = 0; r < size_; ++r) {
    const std::size_t size = bytes[static_cast<std::size_t>(r)];
    if (r == rank_) std::memcpy(result.data() + first, from, size);
    for (std::size_t at = 0; at < size; at += piece)
      MPI_Bcast(result.data() + first + at, as_int(std::min(piece, size - at)), MPI_BYTE, r, MPI_COMM_WORLD);
    first += size;
  }
  return result;
}

std::vector<std::byte> Ranks::gathered(const void* own, std::size_t bytes) {
  if (!several()) return gathered(own, std::vector<std::size_t>{bytes});
  return gathered(own, sizes_of_all(bytes));
}

std::vector<std::byte> Ranks::gathered_on_first(const void* own, std::size_t bytes) {
  if (!several()) return gathered(own, bytes);
  const Waiting timer(counts);
  const std::vector<std::size_t> sizes = sizes_of_all(bytes);
  const auto* from = static_cast<const std::byte*>(own);
  std::vector<std::byte> result;
  std::vector<MPI_Request> open;
  ++counts.reductions;
  if (!first()) {
    send_in_pieces(from, bytes, 0, 0, open);
    wait_for(open);
    return result;
  }
  result.resize(std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)));
  if (bytes > 0) std::memcpy(result.data(), from, bytes);
  std::size_t at = bytes;
  for (int r = 1; r < size_; ++r) {
    receive_in_pieces(result.data() + at, sizes[static_cast<std::size_t>(r)], r, 0, open);
    at += sizes[static_cast<std::size_t>(r)];
  }
  wait_for(open);
  return result;
}

std::vector<std::vector<std::byte>> Ranks::dealt(const std::vector<std::vector<std::byte>>& send) {
  if (!several()) return send;
  const Waiting timer(counts);
  std::vector<std::uint64_t> sizes, coming(send.size());
  for (const auto& s : send) sizes.push_back(s.size());
  MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  std::vector<std::vector<std::byte>> result(send.size());
  std::vector<MPI_Request> open;
  for (std::size_t r = 0; r < send.size(); ++r) {
    if (static_cast<int>(r) == rank_) {
      result[r] = send[r];
      continue;
    }
    result[r].resize(coming[r]);
    receive_in_pieces(result[r].data(), coming[r], static_cast<int>(r), 0, open);
    send_in_pieces(send[r].data(), send[r].size(), static_cast<int>(r), 0, open);
    if (send[r].empty()) continue;
    ++counts.messages, counts.bytes += static_cast<std::int64_t>(send[r].size());
  }
  wait_for(open);
  ++counts.reductions;
  return result;
}

}  // namespace slagflow
