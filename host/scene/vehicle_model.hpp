// SPDX-License-Identifier: Apache-2.0
// Bodies of vehicles made by this program: closed, low-poly, with planar faces of ITU metal; people are of human_skin.
// x points ahead, y to the left, z up; the origin is on the ground below the centre of the vehicle.
#pragma once
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// kind: "car" (bonnet, windscreen, cabin, boot), "van" (a box with a sloped front), "truck" (a cab, a gap and a cargo
// box), "bus", "tram" (sloped at both ends), "motorcycle" (the machine and a rider above it, two bodies) or
// "pedestrian" (a trunk and a head, octagonal from above). The body fills length x width, from a sixth of its height,
// at most 0.35 m (0.03 m where wheels or feet carry it), above the ground up to its height. Its nodes are roof_antenna,
// 5 cm above the middle of its roof or head, and front_antenna and rear_antenna, 5 cm before and behind it at 35% of
// its height. Its materials at the frequency follow from the configuration, as for scenes. Throws ConfigError for
// another kind or a size that is not positive.
Scene vehicle_model(NamedBody kind, double length_m, double width_m, double height_m, const SceneConfig& scene = {},
                    const std::vector<MaterialConfig>& materials = {},
                    double frequency_hz = RadioConfig{}.frequency_hz);

}  // namespace wavetracer
