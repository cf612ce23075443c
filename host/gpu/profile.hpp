// SPDX-License-Identifier: Apache-2.0
// Seconds per stage and per kernel, summed from the profiling events of an in-order queue.
// Events must be added in the order of their commands: all events before a finished one are finished too.
#pragma once
#include <deque>
#include <map>
#include <string>
#include "gpu/opencl.hpp"
#include "wavetracer/kernel_time.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::gpu {

class Profile {
 public:
  // If false, events are not taken and sums stay empty.
  bool on = true;
  // Keeps the event until its time can be read; waits for old ones if more than max_pending are kept. kernel: a second
  // sum that the event counts for, or nullptr for a copy.
  void add(Stage stage, cl::Event event, KernelTime* kernel = nullptr);
  // Returns the sum of a kernel, "program/kernel"; the reference is valid until the next reset.
  KernelTime& kernel(const std::string& name) { return kernels_[name]; }
  // Waits for pending events. Throws cl::Error if a command failed.
  const std::map<Stage, double>& sums();
  // Sums of the kernels that ran. Call it after sums().
  const KernelTimes& kernels() const { return kernels_; }
  void reset();
  size_t pending() const { return pending_.size(); }

  static constexpr size_t max_pending = 4096;

 private:
  struct Pending {
    cl::Event event;
    double* seconds;     // points into sums_, whose nodes do not move
    KernelTime* kernel;  // points into kernels_, in the same way
  };
  void fold(size_t count);

  std::map<Stage, double> sums_;
  KernelTimes kernels_;
  std::deque<Pending> pending_;
};

}  // namespace wavetracer::gpu
