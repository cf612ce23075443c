// SPDX-License-Identifier: Apache-2.0
// Fuzz target: glTF models, those of version 1.0 through assimp and compressed ones through draco, as Debian builds
// both.
#include "fuzz/fuzz.hpp"
#include "scene/model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file("input.glb");
  return fuzz::accept_or_refuse([&] { read_model(file.write(data, size), ModelFormat::gltf); });
}
