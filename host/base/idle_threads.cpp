// SPDX-License-Identifier: Apache-2.0
// The threads have nice value 19: beside a thread of normal priority, such a thread gets about a seventieth of a core.
// Its priority cannot be raised again, so stop() may wait 70 times as long as the running task needs; with SCHED_IDLE
// it would be 340 times.
// This is for Linux only, where each thread has a nice value of its own.
#include "base/idle_threads.hpp"
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace wavetracer {

IdleThreads::IdleThreads(unsigned count) {
  try {
    for (unsigned i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  } catch (...) {
    // There is no memory for another thread: those that were started must end before the exception leaves.
    stop();
    throw;
  }
}

void IdleThreads::enqueue(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (stopped_) return;
    tasks_.push_back(std::move(task));
  }
  changed_.notify_one();
}

void IdleThreads::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void IdleThreads::work() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 19);
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stopped_ || !tasks_.empty(); });
    if (stopped_) return;
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace wavetracer
