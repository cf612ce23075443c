// Worlds that together launch every kernel of a frame: munich, or the generated city where munich is not there.
#pragma once
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

struct FrameWorld {
  std::string name;
  Config config;
  uint32_t frames = 1;  // of a drive; a still world is solved again and again
};

// rays: per transmitter, where a world does not choose them itself.
std::vector<FrameWorld> frame_worlds(const std::string& shared, uint64_t rays, size_t vehicles, uint32_t frames);

}  // namespace wavetracer::bench
