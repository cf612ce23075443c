// SPDX-License-Identifier: Apache-2.0
// Writes radio materials as materials of a glTF file: their names, the colours that people expect, and their laws in
// "extras", so that a custom law is not lost.
#pragma once
#include <nlohmann/json.hpp>
#include "wavetracer/scene.hpp"

namespace wavetracer {

nlohmann::json glb_material(const Material& material);

}  // namespace wavetracer
