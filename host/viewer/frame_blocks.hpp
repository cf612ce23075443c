// SPDX-License-Identifier: Apache-2.0
// Writes frames as blocks of a page, with the strongest paths if not all fit, the gain of every link over time, and
// sampled rays (waypoints.h5). The run is read twice: the first pass counts, so that memory only grows with the rows
// that are kept.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>
#include "results/link_table.hpp"
#include "results/saved_run.hpp"
#include "results/saved_waypoints.hpp"
#include "viewer/grid_maps.hpp"

namespace wavetracer {

struct FrameSelection {
  std::vector<size_t> rows;              // rows of the run's frames
  uint64_t max_paths = 0;                // 0: only bytes are limited
  uint64_t bytes = 0;                    // bytes of base64 for all blocks of frames together
  std::vector<bool> own_receivers = {};  // receivers of the run that are not cells of a grid
  LinkTable links = {};                  // links of the run
  std::vector<GridMap> grids = {};       // grids of the run
  uint64_t area_paths = 0;  // with at most so many paths to cells these get their mean and fading; 0: in no case
};

struct PageBounds {
  glm::dvec3 lower, upper;
};

struct FrameBlocks {
  nlohmann::json frames =
      nlohmann::json::array();           // a row per frame: number, time_s, paths of the frame and paths on the page
  double lowest_db = 0, highest_db = 0;  // range of the finite gains on the page; 0, 0 if there is none
  uint32_t highest_order = 0;
  uint32_t interactions = 0;  // bits of all paths' interactions, as in paths.h5
  // Box around ends and vehicles in all frames, file coordinates; nothing if there are none.
  std::optional<PageBounds> ends_m;
  uint64_t paths = 0, shown_paths = 0, links = 0, shown_links = 0;
  bool beams = false, areas = false;  // links have the columns of beams, and those of the areas of cells
  std::string area_warning;           // says what the areas of cells lack; empty if nothing
};

// Appends the elements block_frame_0, block_frame_1, ... and block_links. page/data.js describes the layouts.
FrameBlocks add_frame_blocks(const SavedRun& run, const FrameSelection& selection, const glm::dvec3& centre_m,
                             std::string& elements);

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
