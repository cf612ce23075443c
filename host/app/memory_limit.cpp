// SPDX-License-Identifier: Apache-2.0
// A signal handler would not work: compilers inside of drivers replace it.
#include "app/memory_limit.hpp"
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <iostream>
#include <string_view>
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

volatile sig_atomic_t child = 0;

// Returns the lower of the limits, in bytes; RLIM_INFINITY without one.
rlim_t limit_bytes() {
  rlimit address_space{RLIM_INFINITY, RLIM_INFINITY}, data{RLIM_INFINITY, RLIM_INFINITY};
  getrlimit(RLIMIT_AS, &address_space);
  getrlimit(RLIMIT_DATA, &data);
  return std::min(address_space.rlim_cur, data.rlim_cur);
}

std::string limit_words(rlim_t bytes) {
  return fmt::format("this process may take {} MiB of memory (`ulimit -v` or `-d`)", bytes >> 20);
}

// Ctrl-C reaches the child directly; a signal sent to this process alone does not.
void forward_signals() {
  struct sigaction action = {};
  action.sa_sigaction = [](int number, siginfo_t* info, void*) {
    if (child > 0 && info->si_code <= 0) kill(child, number);
  };
  action.sa_flags = SA_RESTART | SA_SIGINFO;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGCONT}) sigaction(number, &action, nullptr);
}

int exit_code_of(int status) {
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const int number = WTERMSIG(status);
  if (number != SIGABRT && number != SIGSEGV && number != SIGBUS) {  // as if it had been sent to this process
    std::signal(number, SIG_DFL);
    raise(number);
    return 128 + number;
  }
  std::cerr << "\nwavetracer: a library ended the program (signal " << number
            << "), most likely because it ran out of memory: " << limit_words(limit_bytes())
            << ". Raise the limit, lower trace.batch_rays or trace.rays, or use a smaller scene\n";
  return static_cast<int>(ExitCode::runtime);
}

}  // namespace

int explained(const std::function<int()>& program) {
  if (limit_bytes() == RLIM_INFINITY) return program();
  const pid_t parent = getpid();
  sigset_t all, before;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, &before);  // until both processes have set their handlers
  const pid_t forked = fork();
  if (forked <= 0) {
    if (forked == 0) prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return forked == 0 && getppid() != parent ? static_cast<int>(ExitCode::interrupted) : program();
  }
  child = forked;
  forward_signals();
  sigprocmask(SIG_SETMASK, &before, nullptr);
  int status = 0;
  while (waitpid(forked, &status, 0) < 0 && errno == EINTR) {
  }
  return exit_code_of(status);
}

std::string limit_hint() {
  const rlim_t bytes = limit_bytes();
  return bytes == RLIM_INFINITY ? "" : fmt::format("; {}, which may be too little", limit_words(bytes));
}

}  // namespace wavetracer::app
