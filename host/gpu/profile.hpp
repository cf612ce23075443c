// Seconds per stage and per kernel, summed from the profiling events of an in-order queue.
// Assumes that events are added in the order of their commands, so that a finished one has only finished ones before
// it.
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
  // Off, it takes no events and sums stay empty.
  bool on = true;
  // Keeps the event until its time can be read; waits for old ones where more than max_pending are kept.
  // kernel: what else the event counts for, or nullptr for a copy.
  void add(Stage stage, cl::Event event, KernelTime* kernel = nullptr);
  // The sum of a kernel, "program/kernel"; it stays where it is until the next reset.
  KernelTime& kernel(const std::string& name) { return kernels_[name]; }
  // Waits for what is pending. Throws cl::Error where a command failed.
  const std::map<Stage, double>& sums();
  // Of the kernels that ran. To be read after sums().
  const KernelTimes& kernels() const { return kernels_; }
  void reset();
  size_t pending() const { return pending_.size(); }

  static constexpr size_t max_pending = 4096;

 private:
  struct Pending {
    cl::Event event;
    double* seconds;     // into sums_, whose nodes stay where they are
    KernelTime* kernel;  // likewise into kernels_
  };
  void fold(size_t count);

  std::map<Stage, double> sums_;
  KernelTimes kernels_;
  std::deque<Pending> pending_;
};

}  // namespace wavetracer::gpu
