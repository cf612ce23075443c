// Fuzz target: paths.h5 as view, plot, convert and merge read it. The HDF5 library faults in a process of its own, and
// may there: see hdf5::rehearse().
#include <pthread.h>
#include <csignal>
#include "fuzz/fuzz.hpp"
#include "results/saved_run.hpp"

namespace {

// Faults of that process are no findings.
void end_quietly() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(signal, SIG_DFL);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  [[maybe_unused]] static const int quiet = pthread_atfork(nullptr, nullptr, end_quietly);
  return fuzz::accept_or_refuse([&] {
    const SavedRun run(file.write(data, size));
    for (size_t row = 0; row < run.frame_count() && row < 4; ++row) run.frame(row);
  });
}
