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
  // All of them must outlive it.
  UnitWriter(const Run& run, Shards& shards, Progress& progress);
  // What was given to it is written, though nobody hears of an error.
  ~UnitWriter();
  UnitWriter(const UnitWriter&) = delete;
  UnitWriter& operator=(const UnitWriter&) = delete;

  // Is told from now on of each unit that is whole, by the thread that writes. Must outlive this.
  void tell(MergeAhead& ahead);
  // The frames that follow are of this unit.
  void begin(const Unit& unit);
  // Waits while frames of more than some megabytes wait to be written. Like all that follow, throws what writing threw.
  void add(FrameResult frame);
  // The unit is whole. Waits until the one before is on the disk, so that a process that is killed loses two at most.
  void end();
  // The unit that was begun is not kept.
  void drop();
  // Waits until all is written; units that are whole count as finished then. Nothing else may touch files of the shards
  // before.
  void finish();
  // After finish(): the unit that was begun and neither ended nor dropped; nothing where there is none.
  std::unique_ptr<OpenUnit> unfinished() { return std::move(open_); }

 private:
  struct Task {
    std::function<void()> run;
    size_t bytes;  // of frames in it
  };
  const Run& run_;
  Shards& shards_;
  Progress& progress_;
  // Of the thread, between finish() and begin() of the caller.
  MergeAhead* ahead_ = nullptr;
  std::unique_ptr<OpenUnit> open_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // What follows is guarded by the mutex.
  std::deque<Task> tasks_;
  size_t waiting_bytes_ = 0;
  bool busy_ = false, closing_ = false, done_ = false;
  std::vector<Shard> written_;  // that do not count as finished yet
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses all the others

  void enqueue(size_t bytes, std::function<void()> task);
  void work();
  void perform(const std::function<void()>& task);
  void collect(std::unique_lock<std::mutex>& lock);
};

}  // namespace wavetracer
