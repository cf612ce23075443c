// SPDX-License-Identifier: Apache-2.0
// Measures the stages of a cached depth: each pass over the rays of a scene, by itself, compared with tracing the same
// rays. The machine must be quiet; times are the kernels' by the device's clock, medians.
#pragma once
#include <vector>

#include "cache_rays.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Seconds of one launch over all rays of a segment.
struct StageTimes {
  size_t rays = 0;
  double hash = 0;         // key and hash alone, without a table
  double lookup_miss = 0;  // in a table that holds the earlier segments
  double lookup_hit = 0;   // after the store
  double store = 0;
  double trace = 0;
  double answered = 0;  // share of the rays, after the store
};

// Measures segment by segment, with a table that starts empty and is large enough.
std::vector<StageTimes> stage_times(gpu::Context& context, const SceneRays& rays, CacheConfig config, uint32_t runs);

}  // namespace wavetracer::bench
