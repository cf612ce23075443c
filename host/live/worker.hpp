// A thread that does jobs one after the other, in the order in which they came, and an eventfd that wakes poll() for
// each that is done. Assumes one giver and taker, the thread of the sockets.
#pragma once
#include <sys/eventfd.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "live/endpoint.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live {

template <class Job, class Result>
class Worker {
 public:
  // work: must not throw.
  explicit Worker(std::function<Result(Job&)> work)
      : work_(std::move(work)), event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)) {
    if (*event_ < 0) throw RuntimeError("no file descriptor is left for a thread of the server: raise ulimit -n");
    thread_ = std::thread([this] { run(); });
  }
  ~Worker() {  // after the job that it is at
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void give(Job job) {
    {
      const std::lock_guard lock(mutex_);
      jobs_.push_back(std::move(job));
    }
    wake_.notify_one();
  }
  // Readable as long as take() has something.
  int descriptor() const { return *event_; }
  std::optional<Result> take() {
    uint64_t ignored = 0;
    if (read(*event_, &ignored, sizeof ignored) < 0) return {};
    const std::lock_guard lock(mutex_);
    std::optional<Result> out(std::move(results_.front()));
    results_.pop_front();
    return out;
  }

 private:
  void run() {
    while (true) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
      if (ends_) return;
      Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      Result result = work_(job);
      lock.lock();
      results_.push_back(std::move(result));
      const uint64_t one = 1;
      [[maybe_unused]] const ssize_t written = write(*event_, &one, sizeof one);  // far from the limit of 2^64
    }
  }

  std::function<Result(Job&)> work_;
  Descriptor event_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  std::deque<Result> results_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace wavetracer::live
