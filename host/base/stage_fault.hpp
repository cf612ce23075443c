// SPDX-License-Identifier: Apache-2.0
// Keeps the first exception of the stages of a TBB pipeline. If a stage throws, TBB 2021.8 sometimes leaks one of the
// pipeline's items (the address sanitizer reports it). So stages must not throw: they do their work in run(), which
// records the first exception and ends the pipeline, and rethrow() throws it afterwards.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>

namespace wavetracer {

class StageFault {
 public:
  bool failed() const { return failed_; }

  // Runs the work, unless a stage has failed already.
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
