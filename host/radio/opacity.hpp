// Which surfaces no wave passes: half spaces, metals, thick walls of lossy materials.
// Assumes that loss through a slab grows with the angle of incidence.
#pragma once
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Below this a wave that has passed counts as none: 200 dB, beyond every receiver.
constexpr double least_transmission = 1e-10;

// Throws ConfigError for a material that is not known at this frequency.
bool is_opaque(const Material& material, double frequency_hz);

// Of every surface of the world, by its number; see SurfaceTable.
std::vector<bool> opaque_surfaces(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz);

}  // namespace wavetracer
