// SPDX-License-Identifier: Apache-2.0
// Writes the units of a run, frame by frame, while the next frames are computed.
#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>
#include "jobs/progress.hpp"
#include "jobs/shards.hpp"

namespace wavetracer {

class UnitWriter {
 public:
  // All arguments must outlive this object.
  UnitWriter(const Run& run, Shards& shards, Progress& progress);
  // Writes what it was given, but errors are lost.
  ~UnitWriter();
  UnitWriter(const UnitWriter&) = delete;
  UnitWriter& operator=(const UnitWriter&) = delete;

  // From now on, the writing thread tells `ahead` of each whole unit. It must outlive this object.
  void tell(MergeAhead& ahead);
  // The following frames belong to this unit.
  void begin(const Unit& unit);
  // Waits while frames of more than some megabytes wait to be written. Like all functions below, it throws the writer's
  // exception.
  void add(FrameResult frame);
  // Ends the unit. Waits until the one before is on the disk, so that a process that is killed loses two at most.
  void end();
  // Drops the unit that was begun.
  void drop();
  // Waits until everything is written; whole units count as finished then. Before that, no other code may touch files
  // of the shards.
  void finish();
  // After finish(): returns the unit that was begun and neither ended nor dropped, or null.
  std::unique_ptr<OpenUnit> unfinished() { return std::move(open_); }

 private:
  struct Task {
    std::function<void()> run;
    size_t bytes;  // size of its frames
  };
  const Run& run_;
  Shards& shards_;
  Progress& progress_;
  // Used by the thread, between finish() and begin() of the caller.
  MergeAhead* ahead_ = nullptr;
  std::unique_ptr<OpenUnit> open_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // The mutex guards the following members.
  std::deque<Task> tasks_;
  size_t waiting_bytes_ = 0;
  bool busy_ = false, closing_ = false, done_ = false;
  std::vector<Shard> written_;  // units that do not count as finished yet
  std::exception_ptr failure_;
  std::thread thread_;  // declared last, since it uses all other members

  void enqueue(size_t bytes, std::function<void()> task);
  void work();
  void perform(const std::function<void()>& task);
  void collect(std::unique_lock<std::mutex>& lock);
};

}  // namespace wavetracer
