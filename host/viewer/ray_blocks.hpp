// SPDX-License-Identifier: Apache-2.0
// Writes sampled rays (waypoints.h5) as blocks of a page.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "results/saved_waypoints.hpp"

namespace wavetracer {

struct RayBlocks {
  nlohmann::json frames = nlohmann::json::array();  // for each frame, the number of points on the page
  uint32_t highest_depth = 0;                       // largest depth of a point on the page
  bool sources = false;                             // the file says what found the ends of segments
  std::string warning;                              // says which rays were left out, if any
};

// Appends the elements block_rays_0, block_rays_1, ... for these frames, by their numbers. Points of a ray follow each
// other; receivers that a ray passes are not among them. bytes: limit of base64 for all of them together; if the rays
// do not fit, only every second, third, ... ray of all frames is kept. page/rays.js describes the layout.
RayBlocks add_ray_blocks(const SavedWaypoints& waypoints, const std::vector<uint32_t>& frames,
                         const glm::dvec3& centre_m, uint64_t bytes, std::string& elements);

}  // namespace wavetracer
