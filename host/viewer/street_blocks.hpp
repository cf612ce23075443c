// SPDX-License-Identifier: Apache-2.0
// Writes streets as blocks of a page: flat bands of triangles.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/streets.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns the two rims of a street: for each point of its centre line, without repeated points, the point to its left
// and the point to its right. Empty if the line has no direction.
std::vector<glm::dvec3> street_rims(const Street& street);

// Appends the blocks street_vertices (float32, 3 each) and street_triangles (uint32, 3 each), relative to centre_m.
// Streets more than 100 m from the scene, seen from above, are left out, as the page shows no ground there. Returns a
// sentence if there were more than a page can hold, else nothing.
std::string add_street_blocks(std::span<const Street> streets, const Scene& scene, const glm::dvec3& centre_m,
                              std::string& elements);

}  // namespace wavetracer
