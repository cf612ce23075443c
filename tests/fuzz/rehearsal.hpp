// The processes of hdf5::rehearse(), in which the HDF5 library may fault: that is no finding, and none may take long.
// They must stay as they are, a process for each input: what faults depends on what the memory holds, so only a copy of
// this process meets what this process would.
#pragma once
#include <pthread.h>
#include <sys/time.h>
#include <csignal>

// Of the sanitizers, where they are: else they would report, and libFuzzer would keep the input.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace wavetracer::fuzz {

inline void end_quietly_and_soon() {
  if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(nullptr);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGPROF}) std::signal(signal, SIG_DFL);
  const itimerval limit{{0, 0}, {0, 100000}};  // of the processor; a sound file takes 2 ms
  setitimer(ITIMER_PROF, &limit, nullptr);
}

// Once, before the first input.
inline int tame_rehearsals() { return pthread_atfork(nullptr, nullptr, end_quietly_and_soon); }

}  // namespace wavetracer::fuzz
