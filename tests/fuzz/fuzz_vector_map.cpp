// SPDX-License-Identifier: Apache-2.0
// Fuzz target: maps of the formats that GDAL opens, up to the meshes of their buildings. No file is written. GDAL
// itself is not instrumented: the target searches faults in how this program handles its answers. The fuzzer only uses
// formats of the corpus; the test of the corpus has all of GDAL.
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "fuzz/gdal_drivers.hpp"
#include "imports/map.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"

namespace {

using namespace wavetracer;

int read_map(const std::string& file) {
  return fuzz::accept_or_refuse([&] {
    ImportOptions options;
    options.levels_field = "floors";
    const imports::Map map = imports::read_vector_map(file, options);
    imports::build_scene(imports::plan_city(map, "fuzz", options), nullptr, options);
  });
}

bool set_up() {
  setenv("WAVETRACER_MAPS_MODULE", WAVETRACER_MAPS_FILE, 0);
#ifdef WAVETRACER_FEW_GDAL_DRIVERS
  read_map("/dev/shm");
  fuzz::keep_gdal_drivers({"GeoJSON", "FlatGeobuf", "GML", "LIBKML", "CSV"});
#endif
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static fuzz::MemoryFile file;
  static const bool once = set_up();
  (void)once;
  return read_map(file.write(data, size).string());
}
