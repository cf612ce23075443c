// Where the time of a cached depth goes: each pass on the rays of a scene, by itself, beside tracing the same rays.
// Assumes a quiet machine; times are the kernels' by the device's clock, medians.
#pragma once
#include <vector>

#include "cache_rays.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Seconds of one launch over all rays of a segment.
struct StageTimes {
  size_t rays = 0;
  double hash = 0;         // key and hash alone, no table
  double lookup_miss = 0;  // in a table that holds the segments before
  double lookup_hit = 0;   // after the store
  double store = 0;
  double trace = 0;
  double answered = 0;  // share of the rays, after the store
};

// Segment by segment, through a table that starts empty and is large enough.
std::vector<StageTimes> stage_times(gpu::Context& context, const SceneRays& rays, CacheConfig config, uint32_t runs);

}  // namespace wavetracer::bench
