// SPDX-License-Identifier: Apache-2.0
// Adds up profiling events.
// Half of the pending events are added at a time: by then the device has mostly finished them, so launches seldom wait.
#include "gpu/profile.hpp"

namespace wavetracer::gpu {

void Profile::add(Stage stage, cl::Event event, KernelTime* kernel) {
  if (!on) return;
  pending_.push_back({std::move(event), &sums_[stage], kernel});
  if (pending_.size() > max_pending) fold(max_pending / 2);
}

const std::map<Stage, double>& Profile::sums() {
  fold(pending_.size());
  return sums_;
}

void Profile::reset() {
  pending_.clear();
  sums_.clear();
  kernels_.clear();
}

void Profile::fold(size_t count) {
  if (count == 0) return;
  pending_[count - 1].event.wait();
  for (; count > 0; --count) {
    const Pending& oldest = pending_.front();
    const cl_ulong start = oldest.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    const cl_ulong end = oldest.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    const double seconds = static_cast<double>(end - start) * 1e-9;
    *oldest.seconds += seconds;
    if (oldest.kernel) oldest.kernel->seconds += seconds;
    pending_.pop_front();
  }
}

}  // namespace wavetracer::gpu
