// SPDX-License-Identifier: Apache-2.0
// The limit applies to the first thread alone; stacks of other threads are allocated like any memory.
#include "app/stack.hpp"
#include <pthread.h>
#include <sys/resource.h>
#include <cstring>
#include <string>
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

constexpr size_t enough_bytes = size_t{8} << 20;  // the default of Linux

struct Task {
  const std::function<int()>& program;
  int result = 0;
};

void* run(void* task) {
  static_cast<Task*>(task)->result = static_cast<Task*>(task)->program();
  return nullptr;
}

}  // namespace

int with_enough_stack(const std::function<int()>& program) {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= enough_bytes) return program();
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, enough_bytes);
  pthread_setattr_default_np(&attributes);
  Task task{program};
  pthread_t thread{};
  const int failed = pthread_create(&thread, &attributes, run, &task);
  pthread_attr_destroy(&attributes);
  if (failed != 0)
    throw RuntimeError(std::string("cannot start a thread with 8 MiB of stack (") + std::strerror(failed) +
                       "), and the limit of `ulimit -s` is lower: raise it, for example with `ulimit -s 8192`");
  pthread_join(thread, nullptr);
  return task.result;
}

}  // namespace wavetracer::app
