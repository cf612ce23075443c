// SPDX-License-Identifier: Apache-2.0
// Fuzz target: files of esmini; the text decides between log and recording.
#include "fuzz/fuzz.hpp"
#include "motion/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] {
    const TrajectoryOptions options;
    ByteStream stream(file.write(data, size));
    if (is_esmini_log(stream.peek()))
      read_esmini_log(stream, options);
    else
      read_esmini_recording(stream, options);
  });
}
