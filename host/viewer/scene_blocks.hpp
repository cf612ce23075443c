// SPDX-License-Identifier: Apache-2.0
// Writes the city and the models of vehicles as blocks of a page, and the names of their surfaces.
// Coordinates are relative to the centre that the caller chose.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Appends the elements of the scene's blocks, all called PREFIX_..., and returns the other data that the page needs
// about them. from_centre_m: position of the origin of the scene's vertices. free_edges: whether edges of one face
// count as diffracting.
nlohmann::json add_scene_blocks(const Scene& scene, const std::string& prefix, const glm::dvec3& from_centre_m,
                                bool free_edges, std::string& elements);

// Appends the triangles of volumes of vegetation, by material; returns [name, number of triangles] of each material.
nlohmann::json add_vegetation_block(const Scene& scene, const glm::dvec3& from_centre_m, std::string& elements);

}  // namespace wavetracer
