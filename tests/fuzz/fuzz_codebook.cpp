// SPDX-License-Identifier: Apache-2.0
// Fuzz target: codebooks of beams.
#include "fuzz/fuzz.hpp"
#include "radio/codebook.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] { load_codebook(file.write(data, size), 64); });
}
