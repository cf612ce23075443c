// SPDX-License-Identifier: Apache-2.0
// Fuzz target: PLY meshes of every dialect.
#include "fuzz/fuzz.hpp"
#include "scene/ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  return fuzz::accept_or_refuse([&] {
    const PlyMesh mesh = read_ply(file.write(data, size));
    for (const Triangle& triangle : mesh.triangles)
      for (const uint32_t vertex : triangle)
        if (vertex >= mesh.vertices.size()) std::abort();
  });
}
