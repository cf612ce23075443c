// SPDX-License-Identifier: Apache-2.0
// Fuzz target: traces of OSI.
#include "fuzz/fuzz.hpp"
#include "motion/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] {
    const TrajectoryOptions options;
    ByteStream stream(file.write(data, size));
    read_osi(stream, options);
  });
}
