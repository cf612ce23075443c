// SPDX-License-Identifier: Apache-2.0
// Fuzz target: OBJ models through assimp, whose own code is as Debian builds it.
#include "fuzz/fuzz.hpp"
#include "scene/model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file("input.obj");
  return fuzz::accept_or_refuse([&] { read_model(file.write(data, size), ModelFormat::obj); });
}
