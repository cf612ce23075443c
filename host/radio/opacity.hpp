// SPDX-License-Identifier: Apache-2.0
// The surfaces that no wave passes: half spaces, metals, thick walls of lossy materials. Loss through a slab must grow
// with the angle of incidence.
#pragma once
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A wave that has passed and is weaker than this counts as none: 200 dB, too weak for every receiver.
constexpr double least_transmission = 1e-10;

// A wall of layers is opaque if one of them is. Two layers that are not may resonate, and let waves of some angle pass
// that they hold back at others. Throws ConfigError for a material that is not known at this frequency.
bool is_opaque(const Material& material, double frequency_hz);

// Returns a flag for every surface of the world, by its number; see SurfaceTable.
std::vector<bool> opaque_surfaces(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz);

}  // namespace wavetracer
