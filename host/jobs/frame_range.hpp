// SPDX-License-Identifier: Apache-2.0
// --frames: the frames of a run that are computed.
// Frames are numbered from 0; ranges include both ends.
#pragma once
#include <cstdint>
#include <string>

namespace wavetracer {

struct FrameRange {
  uint32_t first = 0, last = 0;
  uint64_t count() const { return uint64_t{last} - first + 1; }
};

// Throws ConfigError for a text that is no range, or ends before it begins, whatever frames there are.
void check_frames(const std::string& text);

// text: "A:B", "A:", ":B", "A", or empty for all of the frame_count frames. Throws ConfigError.
FrameRange parse_frames(const std::string& text, uint64_t frame_count);

}  // namespace wavetracer
