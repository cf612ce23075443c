// Sampled rays (waypoints.h5) as blocks of a page.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "results/saved_waypoints.hpp"

namespace wavetracer {

struct RayBlocks {
  nlohmann::json frames = nlohmann::json::array();  // of each frame: points on the page
  uint32_t highest_depth = 0;                       // of a point on the page
  bool sources = false;                             // the file says who found where segments end
  std::string warning;                              // which rays were left out, if any
};

// Appends the elements block_rays_0, block_rays_1, ... for these frames, by their numbers. Points of a ray follow each
// other; receivers that a ray passes are not among them. bytes: of base64, of all of them together; where they do not
// fit, every second, third, ... ray is left out of all frames. The layout stands in page/rays.js.
RayBlocks add_ray_blocks(const SavedWaypoints& waypoints, const std::vector<uint32_t>& frames,
                         const glm::dvec3& centre_m, uint64_t bytes, std::string& elements);

}  // namespace wavetracer
