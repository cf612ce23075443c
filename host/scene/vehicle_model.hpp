// Bodies of vehicles, of our own making: closed, low-poly, planar faces of ITU metal.
// Assumes x ahead, y to the left, z up, and the origin on the ground below the centre of the vehicle.
#pragma once
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// kind: "car" (bonnet, windscreen, cabin, boot), "van" (a box with a sloped front) or "truck" (a cab, a gap and a cargo
// box; it serves buses too). The body fills length x width, from a sixth of its height, at most 0.35 m, above the
// ground up to its height. What metal is at the frequency follows from the configuration, as for scenes. Throws
// ConfigError for another kind, and for a size that is not positive.
Scene vehicle_model(NamedBody kind, double length_m, double width_m, double height_m, const SceneConfig& scene = {},
                    const std::vector<MaterialConfig>& materials = {},
                    double frequency_hz = RadioConfig{}.frequency_hz);

}  // namespace wavetracer
