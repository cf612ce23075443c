// SPDX-License-Identifier: Apache-2.0
// Fuzz target: georeference.json beside a scene, and its projection in both directions.
#include <glm/vec2.hpp>
#include "fuzz/fuzz.hpp"
#include "scene/georeference.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file("georeference.json");
  file.write(data, size);
  return fuzz::accept_or_refuse([&] {
    const auto reference = find_georeference(file.path().parent_path() / "city.xml");
    if (!reference) std::abort();
    const Projection projection(*reference);
    projection.scene(projection.geographic({100, -200}));
  });
}
