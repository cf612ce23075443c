// SPDX-License-Identifier: Apache-2.0
// The bodies of vehicles as points of targets: their triangles, cut into pieces.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/device/field_records.h"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// A piece of a body. facet.material is not set.
struct TargetPiece {
  glm::dvec3 centre_m;  // in the coordinates of the model's file: from the middle of the footprint, ahead, left, up
  uint32_t surface;     // a surface of the model
  bool lit_above, lit_below;  // the sides of that surface
  device::wt_target_facet facet;
};

// The pieces of a model of a vehicle, in the order of its triangles. No edge is longer than piece_m: triangles are
// halved across their longest edges. If the triangles bound a volume, they are lit from outside; else from both sides.
// Throws ConfigError, with the name of the target's model, where the pieces are too many.
std::vector<TargetPiece> pieces_of_body(const Scene& model, double piece_m, const std::string& target_model);

}  // namespace wavetracer
