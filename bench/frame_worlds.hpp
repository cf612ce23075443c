// SPDX-License-Identifier: Apache-2.0
// Worlds that together launch every kernel of a frame: munich, or the generated city if munich is missing.
#pragma once
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

struct FrameWorld {
  std::string name;
  Config config;
  uint32_t frames = 1;  // frames of a drive; a world without motion is solved again and again
};

// rays: per transmitter, for worlds that do not choose them themselves.
std::vector<FrameWorld> frame_worlds(const std::string& shared, uint64_t rays, size_t vehicles, uint32_t frames);

}  // namespace wavetracer::bench
