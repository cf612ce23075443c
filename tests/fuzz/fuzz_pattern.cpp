// SPDX-License-Identifier: Apache-2.0
// Fuzz target: antenna patterns.
#include "fuzz/fuzz.hpp"
#include "radio/pattern.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] { load_pattern(file.write(data, size)); });
}
