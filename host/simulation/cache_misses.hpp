// SPDX-License-Identifier: Apache-2.0
// Rays that a ray cache has not answered: each is traced, or with cache.innerframe one of each group of equal keys.
// Traced segments go into the table, and hits to the whole queue.
#pragma once
#include <memory>

#include "passes/cache_groups.hpp"
#include "passes/cache_store.hpp"
#include "passes/compact.hpp"
#include "passes/gather_rays.hpp"
#include "passes/scan.hpp"
#include "passes/trace.hpp"
#include "simulation/ray_trails.hpp"

namespace wavetracer {

// The result of look-ups for a queue, ray by ray.
struct CacheAnswers {
  gpu::Buffer<float> missed;        // [i] is i where ray i is to be traced, else WT_NONE (see Compact)
  gpu::Buffer<uint32_t> receivers;  // with scope = "all": the receiver that the segment passes, or WT_NONE
};

// Counts of missed rays: missed = traced + shared.
struct MissCounts {
  uint32_t traced = 0;
  uint32_t groups = 0;  // groups of equal keys; one ray of each was traced
  uint32_t shared = 0;  // rays that took the hit of another one
};

// Traces marked rays side by side and stores their hits.
class MissTracer {
 public:
  // trails: given where receptions are kept with scope = "all", else null; outlives this.
  MissTracer(gpu::Context& context, const DeviceScene& scene, const CacheTable& table, uint32_t static_surfaces,
             TraceShape shape, const LaunchShape& launch, RayTrails* trails);
  void reserve(uint64_t rays);
  uint32_t capacity() const { return rays_.capacity; }
  // Counts the rays whose mark is not WT_NONE; prepares trace(). One host read.
  uint32_t count(const RayQueue& rays, const gpu::Buffer<float>& marks);
  // Traces the rays that count() has counted, at least one.
  void trace(const DeviceScene& scene, RayQueue& rays, HitList& hits, const gpu::Buffer<float>& marks, uint32_t marked,
             CacheTable& table, uint32_t now, CacheAnswers& answers);

 private:
  gpu::Context& context_;
  uint32_t static_surfaces_;
  bool receives_;
  RayTrails* trails_;
  Compact compact_;
  Scan scan_;
  GatherRays gather_;
  Trace trace_;
  CacheStore store_;
  RayQueue rays_;
  HitList hits_;
  gpu::Buffer<uint32_t> blocks_, indices_;
  gpu::Buffer<uint32_t> receptions_;  // scope = "all": those of the marked rays
};

class CacheMisses {
 public:
  virtual ~CacheMisses() = default;
  // Makes room for queues of this many rays.
  virtual void reserve(uint64_t rays) { tracer_.reserve(rays); }
  uint32_t capacity() const { return tracer_.capacity(); }
  // Finds the hits of the missed rays. Afterwards answers.missed marks those that were traced. now: the frame.
  virtual MissCounts find(const DeviceScene& scene, RayQueue& rays, HitList& hits, CacheTable& table, uint32_t now,
                          CacheAnswers& answers) = 0;

 protected:
  explicit CacheMisses(MissTracer tracer) : tracer_(std::move(tracer)) {}
  MissTracer tracer_;
};

// Makes the kind that cache.innerframe chooses.
std::unique_ptr<CacheMisses> make_cache_misses(gpu::Context& context, const CacheTable& table, uint32_t static_surfaces,
                                               MissTracer tracer);

}  // namespace wavetracer
