// SPDX-License-Identifier: Apache-2.0
// The laws of all points of targets, as wavetracer/device/target.h reads them: a law for each point of each
// [[target_model]], and then for each of its parts ([[target_part]]), in their order.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/device/field_records.h"
#include "wavetracer/target_config.hpp"

namespace wavetracer {

struct TargetLaws {
  std::vector<device::wt_target_law> laws;
  std::vector<device::wt_target_lobe> lobes;
  std::vector<uint32_t> first;  // for each model the law of its first point
};

// Models and parts must be without contradictions (config/target_checks.cpp). All points of a part have one law; those
// of a model's parts follow the laws of its own points.
TargetLaws target_laws(const std::vector<TargetModelConfig>& models, const std::vector<TargetPartConfig>& parts);

// The places of the points of a model, from the middle of the footprint: ahead, left, up. size_m: length, width and
// height of the vehicle; not given at a target that stands.
std::vector<glm::dvec3> points_of(const TargetModelConfig& model, const std::optional<glm::dvec3>& size_m);

}  // namespace wavetracer
