// SPDX-License-Identifier: Apache-2.0
// A run goes through the segments as the first frame of a drive does, and asks again as the second one does. The first
// run is not counted.
#include "cache_stages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "passes/cache_lookup.hpp"
#include "passes/cache_store.hpp"
#include "passes/trace.hpp"
#include "timing.hpp"

namespace wavetracer::bench {
namespace {

// One segment on the device.
struct Launch {
  RayQueue rays;
  HitList traced, hits;
  gpu::Buffer<float> missed;
  gpu::Buffer<uint32_t> indices;  // every ray counts as missed
  gpu::Buffer<uint32_t> hashes;
};

Launch make_launch(gpu::Context& context, const Segment& segment) {
  Launch launch;
  launch.rays = labelled_queue(context, segment);
  launch.traced = make_hit_list(context, segment.rays.size());
  launch.hits = make_hit_list(context, segment.rays.size());
  launch.missed = context.buffer<float>(launch.rays.capacity, "missed");
  std::vector<uint32_t> every(segment.rays.size());
  std::iota(every.begin(), every.end(), 0u);
  launch.indices = context.buffer(every, "indices");
  launch.hashes = context.buffer<uint32_t>(segment.rays.size(), "hashes");
  return launch;
}

double answered(const Launch& launch) {
  const std::vector<float> marks = launch.missed.read(0, launch.rays.count);
  const auto count =
      std::count_if(marks.begin(), marks.end(), [](float mark) { return std::bit_cast<uint32_t>(mark) == WT_NONE; });
  return static_cast<double>(count) / launch.rays.count;
}

}  // namespace

std::vector<StageTimes> stage_times(gpu::Context& context, const SceneRays& rays, CacheConfig config, uint32_t runs) {
  config.buffer_size = rays.count() + rays.count() / 4;  // for a load of 0.8 if each ray had its own key
  CacheTable table = make_cache_table(context, config, 1, static_cast<uint32_t>(rays.scene.surfaces.size()),
                                      static_cast<uint32_t>(rays.scene.triangles.size()));
  const CacheMovement movement = make_cache_movement(context);
  const DeviceScene scene = make_device_scene(context, rays.scene, false);
  CacheLookup lookup(context, table);
  CacheStore store(context, table);
  Trace trace(context, scene, context.info().cpu ? TraceShape::packet16 : TraceShape::bvh2);
  gpu::Kernel hash = context.kernel("probe_cache_rate", "hash_rays", table.definitions(true));
  const uint32_t local = context.info().simple_local_size();

  std::vector<Launch> launches;
  for (const Segment& segment : rays.segments) launches.push_back(make_launch(context, segment));
  enum CacheStage { hashing, missing, tracing, storing, hitting, stage_count };
  std::vector<std::array<std::vector<double>, stage_count>> seconds(launches.size());
  for (uint32_t run = 0; run <= runs; ++run) {
    table.clear(context);
    for (size_t k = 0; k < launches.size(); ++k) {
      Launch& l = launches[k];
      const auto timed = [&](CacheStage stage, const auto& pass) {
        context.finish();
        context.reset_profile();
        pass();
        const double once = device_seconds(context);
        if (run > 0) seconds[k][stage].push_back(once);
      };
      const auto look_up = [&] { lookup(scene, l.rays, l.hits, l.missed, table, movement, WT_NONE, 1, false); };
      timed(hashing, [&] {
        hash({l.rays.count, local}, Stage::transfer, l.rays.planes, l.rays.capacity, l.rays.count, table.widths,
             l.hashes);
      });
      timed(missing, look_up);
      timed(tracing, [&] { trace(scene, l.rays, l.traced); });
      timed(storing, [&] { store(scene, l.rays, l.rays, l.traced, l.indices, l.hits, table, WT_NONE, 1); });
      timed(hitting, look_up);
    }
  }
  std::vector<StageTimes> times;
  for (size_t k = 0; k < launches.size(); ++k) {
    const auto& s = seconds[k];
    times.push_back({.rays = launches[k].rays.count,
                     .hash = median(s[hashing]),
                     .lookup_miss = median(s[missing]),
                     .lookup_hit = median(s[hitting]),
                     .store = median(s[storing]),
                     .trace = median(s[tracing]),
                     .answered = answered(launches[k])});
  }
  return times;
}

}  // namespace wavetracer::bench
