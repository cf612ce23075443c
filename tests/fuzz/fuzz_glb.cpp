// Fuzz target: GLB models through assimp, whose own code is as Debian builds it.
#include "fuzz/fuzz.hpp"
#include "scene/model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file("input.glb");
  return fuzz::accept_or_refuse([&] { read_model(file.write(data, size), ModelFormat::gltf); });
}
