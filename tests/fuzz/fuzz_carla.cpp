// SPDX-License-Identifier: Apache-2.0
// Fuzz target: recordings of CARLA, as its server writes them and as text.
#include "fuzz/fuzz.hpp"
#include "motion/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] {
    const TrajectoryOptions options;
    ByteStream stream(file.write(data, size));
    if (is_carla_recorder_file(stream.peek()))
      read_carla_recorder_file(stream, options);
    else
      read_carla(stream, options);
  });
}
