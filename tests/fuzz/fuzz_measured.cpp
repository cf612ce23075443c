// SPDX-License-Identifier: Apache-2.0
// Fuzz target: tables of measured values, of links and of components, in a coordinate system and without one.
#include "calibration/measured.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  const std::string crs = size % 2 == 1 ? "+proj=utm +zone=32 +ellps=WGS84 +units=m" : "";
  return fuzz::accept_or_refuse([&] { calibration::read_measured(file.write(data, size), {.level = "", .crs = crs}); });
}
