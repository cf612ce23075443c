// SPDX-License-Identifier: Apache-2.0
// A thread that does jobs one after the other, in the order in which they came, and an eventfd that wakes poll() for
// each finished job. Jobs are given and taken by one thread, that of the sockets.
#pragma once
#include <sys/eventfd.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <list>
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
  // work: turns every failure that it knows into an answer; take() rethrows its other exceptions.
  explicit Worker(std::function<Result(Job&)> work)
      : work_(std::move(work)), event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)) {
    if (*event_ < 0) throw RuntimeError("no file descriptor is left for a thread of the server: raise ulimit -n");
    thread_ = std::thread([this] { run(); });
  }
  ~Worker() {  // waits for the current job
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
    std::list<Task> task;  // a list node that is reused for the result
    task.push_back({std::move(job), {}, {}});
    {
      const std::lock_guard lock(mutex_);
      jobs_.splice(jobs_.end(), task);
    }
    wake_.notify_one();
  }
  // Readable as long as take() has a result.
  int descriptor() const { return *event_; }
  std::optional<Result> take() {
    uint64_t ignored = 0;
    if (read(*event_, &ignored, sizeof ignored) < 0) return {};
    std::list<Task> task;
    {
      const std::lock_guard lock(mutex_);
      task.splice(task.end(), results_, results_.begin());
    }
    if (task.front().failure) std::rethrow_exception(task.front().failure);
    return std::move(task.front().result);
  }

 private:
  struct Task {
    Job job;
    std::optional<Result> result;
    std::exception_ptr failure;
  };

  void run() {
    while (true) {
      std::list<Task> task;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
        if (ends_) return;
        task.splice(task.end(), jobs_, jobs_.begin());
      }
      try {
        task.front().result.emplace(work_(task.front().job));
      } catch (...) {
        task.front().failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      results_.splice(results_.end(), task);
      const uint64_t one = 1;
      // The counter is far from its limit of 2^64.
      [[maybe_unused]] const ssize_t written = write(*event_, &one, sizeof one);
    }
  }

  std::function<Result(Job&)> work_;
  Descriptor event_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::list<Task> jobs_, results_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace wavetracer::live
