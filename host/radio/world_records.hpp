// Surfaces, wedges and instances of a world as devices have them, placed in a frame on the host.
// Numbered through the world: those of the static scene, then those of each instance in the order of its model.
#pragma once
#include <span>
#include <vector>

#include "wavetracer/device/records.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Without their triangles.
std::vector<wt_exact_surface> surface_records(const Scene& scene, std::span<const Scene> models,
                                              std::span<const Instance> instances, const WorldState& state);

// In the coordinates of their scene or model, complete but for their place.
std::vector<wt_wedge> wedge_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances);
// The same wedges where the frame has them, and one of them.
void place_wedge(wt_wedge& wedge, const WorldState& state);
void place_wedges(std::vector<wt_wedge>& wedges, const WorldState& state);

// The surface that stands for the plane of each surface, as wedges have it: the lowest one in the plane, and the
// surface itself where no wedge bounds it.
std::vector<uint32_t> plane_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances);

// Without the numbers of surfaces in models.
std::vector<wt_exact_instance> instance_records(std::span<const Instance> instances, const WorldState& state);

}  // namespace wavetracer
