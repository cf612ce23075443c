// SPDX-License-Identifier: Apache-2.0
// A scene of one mesh, whose material is the point of a test.
#pragma once
#include <string>

#include "scene/raw_scene.hpp"

namespace wavetracer::test {

// A material that a scene file names without saying more.
inline RawMaterial named(const std::string& name) { return {name, "scene.xml:3", {}, {}, {}, {}}; }

// A mesh without triangles.
inline RawScene one_mesh(const RawMaterial& material) {
  RawScene raw;
  raw.file = "scene.xml";
  raw.materials = {material};
  raw.meshes.push_back({"wall", "wall.ply", {}, {}, 0});
  return raw;
}

}  // namespace wavetracer::test
