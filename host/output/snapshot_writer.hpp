// Writes snapshots to particles.vtkhdf and walls.vtkhdf on a thread of its own, while the run steps on.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/output/vtkhdf.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {

struct Snapshot {
  FluidSnapshot particles;
  WallSnapshot walls;
  StateTransfer arriving;  // when under way it gives the others
};

struct SnapshotSizes {
  std::size_t particles = 0;  // at the start
  std::size_t walls = 0;      // 0: walls.vtkhdf is not written
  bool heat = false;          // whether temperatures are
};

// The number of time steps that the files hold already.
struct PresentSnapshots {
  explicit PresentSnapshots(std::int64_t n) : count(n) {}
  std::int64_t count;
};

class SnapshotWriter {
 public:
  // Creates the files in an existing folder. Throws Error that names the file.
  SnapshotWriter(const std::string& folder, SnapshotSizes sizes, const VtkhdfWriter::Attributes& attributes);
  // Goes on with the files of an earlier part of the run behind the present time steps; what lies
  // beyond is cut off. Throws Error that names the file, also when it holds fewer.
  SnapshotWriter(const std::string& folder, SnapshotSizes sizes, PresentSnapshots present);
  // Writes what is queued; a failure then is lost, so call close() before.
  ~SnapshotWriter();
  SnapshotWriter(const SnapshotWriter&) = delete;
  SnapshotWriter& operator=(const SnapshotWriter&) = delete;

  bool writes_walls() const { return walls_.has_value(); }

  // Waits until one of the two buffers is free, lets `fill` put a snapshot into it, or start its transfer,
  // and queues it. Throws what `fill` throws, and the Error of an earlier snapshot that could not be written.
  void write(const std::function<void(Snapshot&)>& fill);

  // Waits until all that is queued is written, and flushes it to the disk. Returns the number of time steps
  // in each file. Throws as write does.
  std::int64_t finish_queue();

  // Waits until everything is on disk and ends the thread. Throws as write does.
  void close();

  // Changes attributes of the files; with nothing queued. Throws Error that names the file.
  void describe(const VtkhdfWriter::Attributes& attributes) const;

 private:
  SnapshotWriter(const std::string& folder, SnapshotSizes sizes);
  void work();
  void append(const Snapshot& snapshot);
  void stop();
  void rethrow();

  VtkhdfWriter particles_;
  std::optional<VtkhdfWriter> walls_;
  bool walls_begun_ = false;

  std::array<Snapshot, 2> buffers_;
  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  std::deque<Snapshot*> free_{&buffers_[0], &buffers_[1]}, full_;
  std::int64_t written_ = 0;  // time steps in each file
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace slagflow
