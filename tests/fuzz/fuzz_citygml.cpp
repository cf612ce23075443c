// SPDX-License-Identifier: Apache-2.0
// Fuzz target: CityGML, up to the meshes of its buildings. No file is written.
#include "fuzz/fuzz.hpp"
#include "imports/model_import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  return fuzz::accept_or_refuse([&] {
    ImportOptions options;
    options.lod = "3";
    imports::build_model(imports::read_citygml(fuzz::text_of(data, size), "fuzz.gml", options), "fuzz", options);
  });
}
