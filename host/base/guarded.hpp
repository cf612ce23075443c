// SPDX-License-Identifier: Apache-2.0
// A value that several threads use, and that none of them can reach without holding its lock.
#pragma once
#include <condition_variable>
#include <mutex>
#include <type_traits>
#include <utility>

namespace wavetracer {

template <typename T>
class Guarded {
 public:
  template <typename... Arguments>
  explicit Guarded(Arguments&&... arguments) : value_{std::forward<Arguments>(arguments)...} {}
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  // Calls use(value) while no other thread uses the value, and returns what it returns. Threads that wait in when()
  // then look at the value again. `use` must not call with() or when() of this object, which would wait for itself.
  template <typename Use>
  auto with(const Use& use) {
    std::unique_lock lock(mutex_);
    return run(lock, use);
  }
  // Waits until ready(value) is true, then does the same.
  template <typename Ready, typename Use>
  auto when(const Ready& ready, const Use& use) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready(std::as_const(value_)); });
    return run(lock, use);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  T value_;

  template <typename Use>
  auto run(std::unique_lock<std::mutex>& lock, const Use& use) {
    static_assert(!std::is_reference_v<decltype(use(value_))>, "a reference would outlive the lock");
    static_assert(!std::is_pointer_v<decltype(use(value_))>, "a pointer would outlive the lock");
    // The lock is given back first: a thread that wakes up could not go on otherwise.
    struct Wake {
      std::unique_lock<std::mutex>& lock;
      std::condition_variable& changed;
      ~Wake() {
        lock.unlock();
        changed.notify_all();
      }
    } const wake{lock, changed_};
    return use(value_);
  }
};

}  // namespace wavetracer
