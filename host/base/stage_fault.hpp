// The first exception of the stages of a pipeline. Where a stage throws, TBB 2021.8 loses one of the pipeline's items
// now and then (the address sanitizer sees it). So stages do not throw: they do their work in run(), the first of them
// ends the pipeline once one has failed, and rethrow() throws behind it.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>

namespace wavetracer {

class StageFault {
 public:
  bool failed() const { return failed_; }

  // Nothing is done any more once one has failed.
  template <typename Work>
  void run(const Work& work) {
    if (failed_) return;
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
      failed_ = true;
    }
  }

  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr first_;
};

}  // namespace wavetracer
