#include "host/output/snapshot_writer.hpp"

#include <algorithm>
#include <utility>

#include "host/output/checkpoint_store.hpp"

namespace slagflow {
namespace {

// What the arrays of a snapshot are, and what they hold.
struct Arrays {
  std::vector<ArrayInfo> infos;
  std::vector<ArrayView> views;

  template <class Snapshot>
  explicit Arrays(const Snapshot& snapshot) {
    describe(*this, snapshot);
  }
  template <class Values>
  void operator()(const char* name, const char* unit, const char* meaning, const Values& values) {
    const ArrayView view(values);
    infos.push_back({name, unit, meaning, view.type, view.components});
    views.push_back(view);
  }
};

template <class Snapshot>
std::vector<ArrayInfo> infos_of(bool heat) {
  Snapshot snapshot;
  snapshot.heat = heat;
  return Arrays(snapshot).infos;
}

}  // namespace

SnapshotWriter::SnapshotWriter(const std::string& folder, SnapshotSizes sizes)
    : particles_(folder + "/particles.vtkhdf", infos_of<FluidSnapshot>(sizes.heat)) {
  if (sizes.walls > 0) walls_.emplace(folder + "/walls.vtkhdf", infos_of<WallSnapshot>(sizes.heat));
}

SnapshotWriter::SnapshotWriter(const std::string& folder, SnapshotSizes sizes,
                               const VtkhdfWriter::Attributes& attributes)
    : SnapshotWriter(folder, sizes) {
  particles_.create(attributes, sizes.particles);
  if (walls_) walls_->create(attributes, sizes.walls);
  thread_ = std::thread([this] { work(); });
}

SnapshotWriter::SnapshotWriter(const std::string& folder, SnapshotSizes sizes, PresentSnapshots present)
    : SnapshotWriter(folder, sizes) {
  particles_.truncate(present.count);
  if (walls_) walls_->truncate(present.count);
  walls_begun_ = present.count > 0;
  written_ = present.count;
  thread_ = std::thread([this] { work(); });
}

SnapshotWriter::~SnapshotWriter() { stop(); }

void SnapshotWriter::write(const std::function<void(Snapshot&)>& fill) {
  Snapshot* buffer = nullptr;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !free_.empty() || failure_; });
    rethrow();
    buffer = free_.front();
    free_.pop_front();
  }
  try {
    fill(*buffer);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(buffer);
    throw;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  full_.push_back(buffer);
  changed_.notify_all();
}

std::int64_t SnapshotWriter::finish_queue() {
  std::int64_t written = 0;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return free_.size() == buffers_.size(); });
    rethrow();
    written = written_;
  }
  flush_to_disk(particles_.path());
  if (walls_) flush_to_disk(walls_->path());
  return written;
}

void SnapshotWriter::close() {
  stop();
  rethrow();
}

void SnapshotWriter::describe(const VtkhdfWriter::Attributes& attributes) const {
  particles_.describe(attributes);
  if (walls_) walls_->describe(attributes);
}

void SnapshotWriter::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

// A failure is told once.
void SnapshotWriter::rethrow() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void SnapshotWriter::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !full_.empty() || stopping_; });
    if (full_.empty()) return;
    Snapshot* const buffer = full_.front();
    full_.pop_front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (buffer->arriving.under_way()) buffer->arriving.finish(buffer->particles, buffer->walls);
      append(*buffer);
    } catch (...) {
      failure = std::current_exception();
    }
    buffer->particles = {}, buffer->walls = {};  // between snapshots their memory is free for a checkpoint
    lock.lock();
    if (failure)
      failure_ = failure;
    else
      ++written_;
    free_.push_back(buffer);
    changed_.notify_all();
  }
}

void SnapshotWriter::append(const Snapshot& snapshot) {
  const FluidSnapshot& p = snapshot.particles;
  particles_.append({p.time, p.position, Arrays(p).views});
  if (!walls_) return;
  const WallSnapshot& w = snapshot.walls;
  const PointStep step{w.time, w.position, Arrays(w).views};
  w.moves || !walls_begun_ ? walls_->append(step) : walls_->append_at_same_points(step);
  walls_begun_ = true;
}

}  // namespace slagflow
