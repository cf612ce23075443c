// SPDX-License-Identifier: Apache-2.0
// Fuzz target: CityJSON, up to the meshes of its buildings. No file is written.
#include "fuzz/fuzz.hpp"
#include "imports/model_import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  return fuzz::accept_or_refuse([&] {
    const ImportOptions options;
    imports::build_model(imports::read_cityjson(fuzz::text_of(data, size), "fuzz.city.json", options), "fuzz", options);
  });
}
