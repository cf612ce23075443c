// Fuzz target: paths.h5 as view, plot and convert read it. The HDF5 library may fault where the file is rehearsed, and
// nowhere else.
#include "fuzz/fuzz.hpp"
#include "fuzz/rehearsal.hpp"
#include "output/hdf5_read.hpp"
#include "results/saved_run.hpp"

namespace {

using namespace wavetracer;

fuzz::MemoryFile& input() {
  static fuzz::MemoryFile file;
  return file;
}

}  // namespace

void wavetracer::hdf5::rehearse(const std::function<void()>&) {
  if (fuzz::Rehearsal::here()) return;
  static fuzz::Rehearsal rehearsal([] { SavedRun(input().path()).frame(0); });
  if (!rehearsal.survived()) throw RuntimeError("the file is damaged");
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  input().write(data, size);
  return fuzz::accept_or_refuse([&] {
    const SavedRun run(input().path());
    for (size_t row = 0; row < run.frame_count() && row < 4; ++row) run.frame(row);
  });
}
