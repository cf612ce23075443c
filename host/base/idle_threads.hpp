// Threads of the lowest priority: work that may wait, beside work that must not, where cores have nothing else to do.
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

  // May not throw. Tasks begin in their order.
  void enqueue(std::function<void()> task);
  // Waits for tasks that have begun, which should take milliseconds; the others are dropped, and nothing runs then.
  void stop();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool stopped_ = false;
  std::vector<std::thread> threads_;  // last: they use all the others

  void work();
};

}  // namespace wavetracer
