// Radio materials as those of a glTF file: their names, colours as people expect them, and their laws in extras, so
// that a custom one is not lost.
#pragma once
#include <nlohmann/json.hpp>
#include "wavetracer/scene.hpp"

namespace wavetracer {

nlohmann::json glb_material(const Material& material);

}  // namespace wavetracer
