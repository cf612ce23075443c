// SPDX-License-Identifier: Apache-2.0
// The directions that a frame launches: all of them in a cold frame, a share of them in the frames after it; fewer from
// listeners than from transmitters.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Gives all directions in a cold frame (warm_frames = 0), and after it every stride-th, another set each time: `stride`
// frames together launch all. The sets follow in steps of the golden ratio, so that a few frames are spread evenly.
// refresh_rays: rays of each launcher in such a frame; not set: a tenth.
DirectionShare share_of(uint64_t rays, std::optional<uint64_t> refresh_rays, uint64_t warm_frames);

// The number of rays of each listener. Many rays meet edges, so a tenth of trace.rays suffices, but at least 100,000.
uint64_t listener_rays(const TraceConfig& trace);

// The launches of a frame with a fixed number of rays: transmitters, then listeners where there are some.
std::vector<Launch> frame_launches(const TraceConfig& trace, std::vector<Launcher> transmitters,
                                   std::vector<Launcher> listeners, uint64_t warm_frames);

// About 4096 directions, for kernels that are compiled when they are first launched.
DirectionShare few_directions(uint64_t rays);

}  // namespace wavetracer
