// SPDX-License-Identifier: Apache-2.0
// The children of LimitedChild, in which the HDF5 library may crash: that is no finding, and no child may take long.
// Each input must have its own process: whether the library crashes depends on the content of memory, so only a copy of
// this process behaves as this process would.
#pragma once
#include <pthread.h>
#include <sys/time.h>
#include <csignal>

// This is the sanitizers' function, if they are there: else they would report, and libFuzzer would keep the input.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace wavetracer::fuzz {

inline void end_quietly_and_soon() {
  if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(nullptr);
  std::signal(SIGVTALRM, SIG_DFL);
  // The limit is processor time for all requests; a sound file takes 2 ms. LimitedChild's own timer is another one.
  const itimerval limit{{0, 0}, {0, 100000}};
  setitimer(ITIMER_VIRTUAL, &limit, nullptr);
}

// It is called once, before the first input.
inline int tame_children() { return pthread_atfork(nullptr, nullptr, end_quietly_and_soon); }

}  // namespace wavetracer::fuzz
