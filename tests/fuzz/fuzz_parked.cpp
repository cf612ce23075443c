// SPDX-License-Identifier: Apache-2.0
// Fuzz target: files of parked vehicles.
#include "fuzz/fuzz.hpp"
#include "motion/parked.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] { read_parked(file.write(data, size)); });
}
