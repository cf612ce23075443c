// Reading a file that may be damaged where it can do no harm first.
// Assumes that what the child has read the parent can read, too: both run the same code on the same bytes.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include "output/hdf5_read.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::hdf5 {
namespace {

constexpr rlim_t most_seconds = 60;  // of the processor

[[noreturn]] void run_child(const std::function<void()>& reading) {
  const rlimit time{most_seconds, most_seconds}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_CORE, &no_core);
  try {
    reading();
  } catch (...) {  // the parent will meet it, and report it
  }
  _exit(0);  // nothing of the parent's is flushed or removed
}

}  // namespace

void rehearse(const std::function<void()>& reading) {
  const pid_t child = fork();
  if (child < 0) throw RuntimeError(std::string("cannot start a process: ") + std::strerror(errno));
  if (child == 0) run_child(reading);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw RuntimeError(std::string("cannot wait for a process: ") + std::strerror(errno));
  if (status != 0) throw RuntimeError("the file is damaged: the HDF5 library fails on it");
}

}  // namespace wavetracer::hdf5
