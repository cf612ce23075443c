// Fuzz target: maps of the formats that GDAL opens, up to the meshes of their buildings. No file is written. GDAL
// itself is not instrumented: what is looked for is what this program makes of its answers.
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"
#include "imports/vector_map.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  static const int module = setenv("WAVETRACER_MAPS_MODULE", WAVETRACER_MAPS_FILE, 1);
  (void)module;
  return fuzz::accept_or_refuse([&] {
    ImportOptions options;
    options.levels_field = "floors";
    const imports::Map map = imports::read_vector_map(file.write(data, size).string(), options);
    imports::build_scene(imports::plan_city(map, "fuzz", options), nullptr, options);
  });
}
