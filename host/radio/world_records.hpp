// SPDX-License-Identifier: Apache-2.0
// Surfaces, wedges and instances of a world in the form that devices have, placed in a frame on the host. Numbers are
// those of the world: those of the static scene, then those of each instance in the order of its model.
#pragma once
#include <span>
#include <vector>

#include "wavetracer/device/records.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// The surfaces without their triangles.
std::vector<wt_exact_surface> surface_records(const Scene& scene, std::span<const Scene> models,
                                              std::span<const Instance> instances, const WorldState& state);

// The wedges in the coordinates of their scene or model, complete except for their place.
std::vector<wt_wedge> wedge_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances);
// Moves one of these wedges to its place in the frame.
void place_wedge(wt_wedge& wedge, const WorldState& state);
void place_wedges(std::vector<wt_wedge>& wedges, const WorldState& state);

// The surface that stands for the plane of each surface, as wedges name it: the lowest one in the plane, and the
// surface itself where no wedge bounds it.
std::vector<uint32_t> plane_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances);

// The instances without the numbers of surfaces in models.
std::vector<wt_exact_instance> instance_records(std::span<const Instance> instances, const WorldState& state);

// The points of targets in a frame.
std::vector<wt_target_point> target_records(const WorldState& state);

}  // namespace wavetracer
