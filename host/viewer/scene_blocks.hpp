// SPDX-License-Identifier: Apache-2.0
// Writes the city, its streets and the models of vehicles as blocks of a page, and the names of their surfaces.
// Coordinates are relative to the centre that the caller chose.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/streets.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Appends the elements of the scene's blocks, all called PREFIX_..., and returns the other data that the page needs
// about them. from_centre_m: position of the origin of the scene's vertices. free_edges: whether edges of one face
// count as diffracting.
nlohmann::json add_scene_blocks(const Scene& scene, const std::string& prefix, const glm::dvec3& from_centre_m,
                                bool free_edges, std::string& elements);

// Appends the triangles of volumes of vegetation, by material; returns [name, number of triangles] of each material.
nlohmann::json add_vegetation_block(const Scene& scene, const glm::dvec3& from_centre_m, std::string& elements);

// Returns the two rims of a street: for each point of its centre line, without repeated points, the point to its left
// and the point to its right. Empty if the line has no direction.
std::vector<glm::dvec3> street_rims(const Street& street);

// Appends the blocks street_vertices (float32, 3 each) and street_triangles (uint32, 3 each), relative to centre_m.
// Streets more than 100 m from the scene, seen from above, are left out, as the page shows no ground there. Returns a
// sentence if there were more than a page can hold, else nothing.
std::string add_street_blocks(std::span<const Street> streets, const Scene& scene, const glm::dvec3& centre_m,
                              std::string& elements);

}  // namespace wavetracer
