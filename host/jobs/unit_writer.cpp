// SPDX-License-Identifier: Apache-2.0
// One thread alone calls HDF5 until it has finished.
// Objects that a Run refers to must not change while frames are computed.
#include "jobs/unit_writer.hpp"
#include <fmt/format.h>

namespace wavetracer {
namespace {

constexpr size_t most_waiting_bytes = size_t{1} << 26;

// Estimates the memory of a frame.
size_t bytes_of(const FrameResult& frame) {
  constexpr size_t path = 180, vertex = 33, waypoint = 53, entry = 36, beam = 24, fields = 80;
  const WorldState& world = frame.world;
  return frame.paths.size() * path + frame.paths.vertex_position_m.size() * vertex + frame.waypoints.size() * waypoint +
         frame.cache_entries.size() * entry + frame.responses.h.size() * sizeof frame.responses.h[0] +
         frame.beams.size() * beam + frame.carriers.size() * frame.paths.size() * fields +
         world.links.size() * sizeof(Link) + world.instances.size() * sizeof(Placement) +
         (world.transmitters.size() + world.receivers.size()) * sizeof(EndState);
}

}  // namespace

UnitWriter::UnitWriter(const Run& run, Shards& shards, Progress& progress)
    : run_(run), shards_(shards), progress_(progress), thread_([this] { work(); }) {}

UnitWriter::~UnitWriter() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void UnitWriter::tell(MergeAhead& ahead) {
  enqueue(0, [this, &ahead] { ahead_ = &ahead; });
}

void UnitWriter::begin(const Unit& unit) {
  enqueue(0, [this, unit] { open_ = shards_.open(run_, unit); });
}

void UnitWriter::add(FrameResult frame) {
  const auto kept = std::make_shared<const FrameResult>(std::move(frame));  // tasks must be copyable
  enqueue(bytes_of(*kept), [this, kept] { open_->add(*kept); });
}

void UnitWriter::end() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !closing_ || failure_; });
    closing_ = true;
  }
  enqueue(0, [this] {
    Shard shard = shards_.close(*open_);
    open_.reset();
    const std::lock_guard lock(mutex_);
    written_.push_back(std::move(shard));
    closing_ = false;
  });
  enqueue(0, [this] {
    if (ahead_) ahead_->look();
  });
}

void UnitWriter::drop() {
  enqueue(0, [this] { open_.reset(); });
}

void UnitWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return tasks_.empty() && !busy_; });
  collect(lock);
}

void UnitWriter::enqueue(size_t bytes, std::function<void()> task) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_bytes_ <= most_waiting_bytes; });
  collect(lock);
  tasks_.push_back({std::move(task), bytes});
  waiting_bytes_ += bytes;
  lock.unlock();
  changed_.notify_all();
}

// Units written so far count as finished from here on; throws the writer's exception.
void UnitWriter::collect(std::unique_lock<std::mutex>& lock) {
  const std::vector<Shard> written = std::exchange(written_, {});
  const std::exception_ptr failure = failure_;
  lock.unlock();
  for (const Shard& shard : written) {
    shards_.finish(shard);
    progress_.line(fmt::format("{}: {} paths", unit_words(shard.unit), shard.totals.counts.paths));
  }
  if (failure) std::rethrow_exception(failure);
  lock.lock();
}

void UnitWriter::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return done_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    busy_ = true;
    {
      const Task task = std::move(tasks_.front());
      tasks_.pop_front();
      const bool failed = failure_ != nullptr;
      lock.unlock();
      if (!failed) perform(task.run);
      lock.lock();
      waiting_bytes_ -= task.bytes;
    }
    busy_ = false;
    changed_.notify_all();
  }
}

void UnitWriter::perform(const std::function<void()>& task) {
  try {
    task();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

}  // namespace wavetracer
