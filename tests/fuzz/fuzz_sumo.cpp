// SPDX-License-Identifier: Apache-2.0
// Fuzz target: polygons of SUMO, up to the meshes of their buildings, and the <location> of its networks.
// No file is written.
#include "fuzz/fuzz.hpp"
#include "imports/map.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::accept_or_refuse([&] { imports::sumo_location(text, "fuzz.net.xml"); });
  return fuzz::accept_or_refuse([&] {
    const ImportOptions options;
    const imports::Map map = imports::read_sumo_polygons(text, "fuzz.poly.xml");
    imports::build_scene(imports::plan_city(map, "fuzz.poly.xml", options), nullptr, options);
  });
}
