// Frames as blocks of a page, strongest paths first where they do not all fit, and the gain of every link over time.
// Two passes over the run: the first counts, so that memory does not grow with the number of frames but by what is
// kept.
#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>
#include "results/link_table.hpp"
#include "results/saved_run.hpp"

namespace wavetracer {

struct FrameSelection {
  std::vector<size_t> rows;              // of the run
  uint64_t max_paths = 0;                // 0: no limit but bytes
  uint64_t bytes = 0;                    // of base64, of all blocks of frames together
  std::vector<bool> own_receivers = {};  // of the run: those that are no cells of a grid
  LinkTable links = {};                  // of the run
};

struct PageBounds {
  glm::dvec3 lower, upper;
};

struct FrameBlocks {
  nlohmann::json frames =
      nlohmann::json::array();           // a row per frame: number, time_s, paths there were and paths on the page
  double lowest_db = 0, highest_db = 0;  // of the finite gains on the page; 0, 0: there is none
  uint32_t highest_order = 0;
  uint32_t interactions = 0;         // of all paths, bits as in paths.h5
  std::optional<PageBounds> ends_m;  // around ends and vehicles in all frames, file coordinates; nothing without any
  uint64_t paths = 0, shown_paths = 0, links = 0, shown_links = 0;
};

// Appends the elements block_frame_0, block_frame_1, ... and block_links. Layouts stand in page/data.js.
FrameBlocks add_frame_blocks(const SavedRun& run, const FrameSelection& selection, const glm::dvec3& centre_m,
                             std::string& elements);

}  // namespace wavetracer
