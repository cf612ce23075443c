// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests against the reference path lists.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace wavetracer::test {

inline glm::dvec3 to_vector(const nlohmann::json& v) { return {v[0], v[1], v[2]}; }

}  // namespace wavetracer::test
