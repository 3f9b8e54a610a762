// Writes snapshots to particles.vtkhdf and walls.vtkhdf on a thread of its own, while the run steps on.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/vtkhdf.hpp"
#include "simulation.hpp"

namespace slagflow {

struct Snapshot {
  FluidSnapshot particles;
  WallSnapshot walls;
};

struct SnapshotSizes {
  std::size_t particles = 0;  // at the start
  std::size_t walls = 0;      // 0: walls.vtkhdf is not written
};

class SnapshotWriter {
 public:
  // Creates the files in an existing folder. Throws Error that names the file.
  SnapshotWriter(const std::string& folder, SnapshotSizes sizes, const VtkhdfWriter::Attributes& attributes);
  // Writes what is queued; a failure then is lost, so call close() before.
  ~SnapshotWriter();
  SnapshotWriter(const SnapshotWriter&) = delete;
  SnapshotWriter& operator=(const SnapshotWriter&) = delete;

  bool writes_walls() const { return walls_.has_value(); }

  // Waits until one of the two buffers is free, lets `fill` put a snapshot into it and queues it.
  // Throws what `fill` throws, and the Error of an earlier snapshot that could not be written.
  void write(const std::function<void(Snapshot&)>& fill);

  // Waits until everything is on disk and ends the thread. Throws as write does.
  void close();

 private:
  void work();
  void append(const Snapshot& snapshot);
  void stop();
  void rethrow();

  VtkhdfWriter particles_;
  std::optional<VtkhdfWriter> walls_;
  bool walls_begun_ = false;
  std::vector<Vector3<float>> positions_;  // the thread's scratch

  std::array<Snapshot, 2> buffers_;
  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  std::deque<Snapshot*> free_{&buffers_[0], &buffers_[1]}, full_;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace slagflow
