// Fuzz target: trajectories, SUMO FCD and CSV, plain or gzip; the content decides.
#include "fuzz/fuzz.hpp"
#include "motion/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] { read_trajectories(file.write(data, size)); });
}
