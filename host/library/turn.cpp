// SPDX-License-Identifier: Apache-2.0
// Threads and processes of the C interface.
// No thread may begin to use a simulation that is being closed.
#include <unistd.h>
#include <string>
#include "library/handles.hpp"

namespace wavetracer::c_api {
namespace {

// The first process that used a device; processes forked from it inherit the value.
std::atomic<pid_t> first_process{0};

[[noreturn]] void refuse_fork(const char* function) {
  throw RuntimeError(
      std::string(function) +
      ": this process was forked from one that has used wavetracer, and the threads of OpenCL are not in it: "
      "start a process of its own instead of forking (in Python: "
      "multiprocessing.get_context(\"spawn\")), or use wavetracer only after the fork");
}

}  // namespace

void check_process(const char* function) {
  pid_t first = 0;
  if (!first_process.compare_exchange_strong(first, getpid()) && first != getpid()) refuse_fork(function);
}

Turn::Turn(const wavetracer_simulation& self, const char* function) : self_(self) {
  if (self.process != getpid()) refuse_fork(function);
  if (self.user == std::this_thread::get_id())
    throw ConfigError(std::string(function) +
                      ": this simulation is solving a frame, and what watches the frame cannot do this; "
                      "do it when the frame is there");
  self.turn.lock();
  self.user = std::this_thread::get_id();
}

Turn::~Turn() {
  self_.user = std::thread::id();
  self_.turn.unlock();
}

void close_simulation(wavetracer_simulation* self) noexcept {
  if (!self || self->process != getpid() || self->user == std::this_thread::get_id()) return;
  self->turn.lock();
  self->turn.unlock();
  delete self;
}

}  // namespace wavetracer::c_api
