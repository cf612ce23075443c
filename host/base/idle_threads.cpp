// Nice 19: of a core that others want, such a thread has a seventieth. It cannot get its priority back, so stop() may
// wait 70 times as long for a task as that takes; SCHED_IDLE would make it 340 times.
// Linux only: threads there have nice values of their own.
#include "base/idle_threads.hpp"
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace wavetracer {

IdleThreads::IdleThreads(unsigned count) {
  try {
    for (unsigned i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  } catch (...) {  // no memory for another one: those that were started must end before this does
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
