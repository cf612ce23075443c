// SPDX-License-Identifier: Apache-2.0
// The laws of all points of targets, as wavetracer/device/target.h reads them: a law for each point of each
// [[target_model]], and then for each of its parts ([[target_part]]), in their order.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "radio/target_pieces.hpp"
#include "wavetracer/device/field_records.h"
#include "wavetracer/target_config.hpp"

namespace wavetracer {

struct TargetLaws {
  std::vector<device::wt_target_law> laws;
  std::vector<device::wt_target_lobe> lobes;
  std::vector<device::wt_target_facet> facets;  // pieces of bodies, without their materials
  std::vector<uint32_t> first;                  // for each model the law of its first point; of a body, of its parts
  // With kind = "body" the pieces of every model of a vehicle; other models have none. first_law: that of the first
  // piece.
  struct BodyLaws {
    std::vector<TargetPiece> pieces;
    uint32_t first_law = 0;
  };
  std::vector<std::vector<BodyLaws>> bodies;
};

// Models and parts must be without contradictions (config/target_checks.cpp). All points of a part have one law; those
// of a model's parts follow the laws of its own points. vehicles: the models of vehicles. Throws ConfigError as
// pieces_of_body does.
TargetLaws target_laws(const std::vector<TargetModelConfig>& models, const std::vector<TargetPartConfig>& parts,
                       std::span<const Scene> vehicles);

// The places of the points of a model, from the middle of the footprint: ahead, left, up; none with kind = "body".
// size_m: length, width and height of the vehicle; not given at a target that stands.
std::vector<glm::dvec3> points_of(const TargetModelConfig& model, const std::optional<glm::dvec3>& size_m);

}  // namespace wavetracer
