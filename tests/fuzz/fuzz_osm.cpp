// SPDX-License-Identifier: Apache-2.0
// Fuzz target: maps of OpenStreetMap, XML or PBF, up to the meshes of their buildings. No file is written.
#include "fuzz/fuzz.hpp"
#include "imports/map.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  return fuzz::accept_or_refuse([&] {
    ImportOptions options;
    options.vegetation = size % 2 == 1;
    const imports::Map map = imports::read_osm(fuzz::text_of(data, size), "fuzz.osm", options);
    imports::build_scene(imports::plan_city(map, "fuzz.osm", options), nullptr, options);
  });
}
