// SPDX-License-Identifier: Apache-2.0
// Fuzz target: Mitsuba XML scenes. Meshes that they name do not exist, except the file itself.
#include "fuzz/fuzz.hpp"
#include "scene/mitsuba.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] { read_mitsuba(file.write(data, size)); });
}
