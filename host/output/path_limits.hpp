// SPDX-License-Identifier: Apache-2.0
// Decides which paths of a frame are written, by output.paths, min_gain_db, dynamic_range_db and max_paths_per_link.
// Omitted paths are counted with their power; figures of links include all paths.
#pragma once
#include <cstdint>
#include <span>
#include <vector>
#include "wavetracer/config.hpp"
#include "wavetracer/frame_result.hpp"

namespace wavetracer {

// Powers are |a|^2 summed over pairs of ports.
struct LeftOutPaths {
  uint64_t paths = 0;
  double power = 0;  // power of these
  double all = 0;    // power of all paths, for comparison
};

// Tells whether the configuration may omit paths at all.
bool limits_paths(const OutputConfig& output);

// Tells for each row whether it is written. paths: sorted as Paths says.
std::vector<uint8_t> written_rows(const Paths& paths, const OutputConfig& output);

// Returns these rows, in their order, with their vertices.
Paths select_rows(const Paths& paths, std::span<const uint8_t> written);
std::vector<CarrierFields> select_rows(const std::vector<CarrierFields>& carriers, std::span<const uint8_t> written);

// Returns the paths among rows first to end - 1 that are not written.
LeftOutPaths left_out(const Paths& paths, std::span<const uint8_t> written, size_t first, size_t end);
// Does the same for all paths of a frame; if the device has summed them, none is written.
LeftOutPaths left_out(const FrameResult& frame, std::span<const uint8_t> written);

}  // namespace wavetracer
