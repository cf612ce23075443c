// Which directions a frame launches: all of them in a cold frame, a share of them in the frames after it; fewer from
// listeners than from transmitters.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// All directions in a cold frame (warm_frames = 0); after it every stride-th, another set each time: `stride` frames
// together launch all. Steps of the golden ratio, so that a few frames spread evenly. refresh_rays: of each launcher in
// such a frame; where none is given, a tenth.
DirectionShare share_of(uint64_t rays, std::optional<uint64_t> refresh_rays, uint64_t warm_frames);

// Rays of each listener. Edges are met by many rays, so a tenth of trace.rays suffices, but not less than 100,000.
uint64_t listener_rays(const TraceConfig& trace);

// The launches of a frame with a fixed number of rays: transmitters, then listeners where there are some.
std::vector<Launch> frame_launches(const TraceConfig& trace, std::vector<Launcher> transmitters,
                                   std::vector<Launcher> listeners, uint64_t warm_frames);

// About 4096 directions, for kernels that are compiled when they are first launched.
DirectionShare few_directions(uint64_t rays);

}  // namespace wavetracer
