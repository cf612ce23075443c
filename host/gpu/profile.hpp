// Seconds a stage, summed from the profiling events of an in-order queue.
// Assumes that events are added in the order of their commands, so that a finished one has only finished ones before
// it.
#pragma once
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include "gpu/opencl.hpp"

namespace wavetracer::gpu {

class Profile {
 public:
  // Off, it takes no events and sums stay empty.
  bool on = true;
  // Keeps the event until its time can be read; waits for old ones where more than max_pending are kept.
  void add(std::string_view stage, cl::Event event);
  // Waits for what is pending. Throws cl::Error where a command failed.
  const std::map<std::string, double, std::less<>>& sums();
  void reset();
  size_t pending() const { return pending_.size(); }

  static constexpr size_t max_pending = 4096;

 private:
  struct Pending {
    cl::Event event;
    double* seconds;  // into sums_, whose nodes stay where they are
  };
  void fold(size_t count);

  std::map<std::string, double, std::less<>> sums_;
  std::deque<Pending> pending_;
};

}  // namespace wavetracer::gpu
