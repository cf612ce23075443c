// SPDX-License-Identifier: Apache-2.0
// --frames of commands that read a saved run: the rows of the frames that a user names by their numbers.
#pragma once
#include <cstddef>
#include <string>
#include "results/saved_run.hpp"

namespace wavetracer::app {

// Rows of a run from the first to the last, both included.
struct FrameRows {
  size_t first = 0, last = 0;
};

// text: "A:B", "A:", ":B", "A", or empty for all frames (jobs/frame_range.hpp). Frames of a part of a run keep their
// numbers. Throws ConfigError if the run has none of these frames.
FrameRows frame_rows(const SavedRun& run, const std::string& text);

}  // namespace wavetracer::app
