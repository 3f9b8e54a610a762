// The processes that share a run, each with its part of the particles: what they tell each other. Without
// MPI, or without a launcher, there is one, and all of this costs nothing. Every call is one of all ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace slagflow {

// What went between the ranks, as one of them counts it.
struct RankCounts {
  std::int64_t messages = 0, bytes = 0;  // sent to neighbours, halos and particles
  std::int64_t exchanges = 0;            // of halos
  std::int64_t reductions = 0;           // sums, maxima, and what is gathered
  double waiting = 0;                    // [s] in all of these
};

// A message to a neighbour and the one that it sends at the same time; rank < 0: none.
struct Message {
  int rank = -1;
  const std::byte* send = nullptr;
  std::size_t send_bytes = 0;
  std::byte* receive = nullptr;
  std::size_t receive_bytes = 0;
  int send_tag = 0, receive_tag = 0;
};

class Ranks {
 public:
  static Ranks& world();

  // Starts MPI where a launcher tells of more than one rank. From then on only the first writes to stdout and
  // stderr. Throws InputError where the program was built without MPI.
  void start(int& argc, char**& argv);
  void end();
  // Ends all ranks at once, of which not all know why: says so on stderr.
  [[noreturn]] void abort(int exit_code, const std::string& reason);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool several() const { return size_ > 1; }
  bool first() const { return rank_ == 0; }
  int local_rank() const { return local_rank_; }  // among those of this machine
  static bool built_in();                         // whether this program has MPI

  void exchange(const std::vector<Message>&);

  // Sums over the ranks of whole numbers.
  void add(std::int64_t* values, std::size_t count);
  std::int64_t added(std::int64_t value) {
    add(&value, 1);
    return value;
  }
  // The largest of the ranks; a not-a-number of any yields not-a-number.
  void take_largest(double* values, std::size_t count);
  // Of bytes that are zero on all ranks but one, those of that one.
  void join(void* bytes, std::size_t count);
  // What the first rank has, on all.
  void share(void* bytes, std::size_t count);
  template <class T>
  T shared(T value) {
    share(&value, sizeof value);
    return value;
  }

  // All that the ranks have, in their order, on all of them: bytes[r] of rank r.
  std::vector<std::byte> gathered(const void* own, const std::vector<std::size_t>& bytes);
  template <class T>
  std::vector<T> gathered_by(const std::vector<T>& own, const std::vector<std::size_t>& bytes) {
    return as_values<T>(gathered(own.data(), bytes));
  }
  // The same, of as many bytes as each has.
  std::vector<std::byte> gathered(const void* own, std::size_t bytes);
  // The same on the first rank only; nothing elsewhere.
  std::vector<std::byte> gathered_on_first(const void* own, std::size_t bytes);
  template <class T>
  std::vector<T> gathered(const std::vector<T>& own) {
    return as_values<T>(gathered(own.data(), own.size() * sizeof(T)));
  }
  template <class T>
  std::vector<T> gathered_on_first(const std::vector<T>& own) {
    return as_values<T>(gathered_on_first(own.data(), own.size() * sizeof(T)));
  }
  // send[r] goes to rank r; returns what came, in the order of the ranks.
  std::vector<std::vector<std::byte>> dealt(const std::vector<std::vector<std::byte>>& send);

  RankCounts counts;

 private:
  Ranks() = default;
  template <class T>
  static std::vector<T> as_values(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::vector<std::size_t> sizes_of_all(std::size_t own);
  static bool launched_with_others();
  int rank_ = 0, size_ = 1, local_rank_ = 0;
  bool started_ = false;
  int stderr_ = 2;  // file descriptor
};

inline Ranks& ranks() { return Ranks::world(); }

}  // namespace slagflow
