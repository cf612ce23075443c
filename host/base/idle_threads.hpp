// SPDX-License-Identifier: Apache-2.0
// Threads of the lowest priority: they do work that may wait, on cores that have nothing more urgent to do.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace wavetracer {

class IdleThreads {
 public:
  explicit IdleThreads(unsigned count);
  ~IdleThreads() { stop(); }
  IdleThreads(const IdleThreads&) = delete;
  IdleThreads& operator=(const IdleThreads&) = delete;

  // The task must not throw. Tasks begin in the order in which they were added.
  void enqueue(std::function<void()> task);
  // Waits for the tasks that have begun, which should take milliseconds, and drops the others. No task runs after it
  // returns.
  void stop();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool stopped_ = false;
  std::vector<std::thread> threads_;  // declared last, since the threads use all other members

  void work();
};

}  // namespace wavetracer
