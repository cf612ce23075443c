// SPDX-License-Identifier: Apache-2.0
// Fuzz target: rasters of heights that GDAL opens, up to the mesh of the ground.
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "imports/terrain.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  static const int module = setenv("WAVETRACER_MAPS_MODULE", WAVETRACER_MAPS_FILE, 1);
  (void)module;
  return fuzz::accept_or_refuse([&] {
    ImportOptions options;
    options.terrain = file.write(data, size);
    const Georeference place{"+proj=utm +zone=32 +ellps=WGS84 +units=m", {-691570, -5334730}, {}, {}};
    imports::read_terrain({{-40, -40}, {40, 40}}, place, options);
  });
}
