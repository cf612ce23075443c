// Rays that a ray cache has not answered: each is traced, or with cache.innerframe one of each group of equal keys.
// What was traced goes into the table, and the hits to the whole queue.
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

// What look-ups leave of a queue, ray by ray.
struct CacheAnswers {
  gpu::Buffer<float> missed;        // [i]: i where ray i is to be traced, else WT_NONE (see Compact)
  gpu::Buffer<uint32_t> receivers;  // with scope = "all": the receiver that the segment passes, or WT_NONE
};

// missed = traced + shared.
struct MissCounts {
  uint32_t traced = 0;
  uint32_t groups = 0;  // of equal keys, of which one ray each was traced
  uint32_t shared = 0;  // rays that took the hit of another one
};

// Traces marked rays side by side and stores what they hit.
class MissTracer {
 public:
  // trails: where receptions are kept with scope = "all", else null; outlives this.
  MissTracer(gpu::Context& context, const DeviceScene& scene, const CacheTable& table, uint32_t static_surfaces,
             TraceShape shape, const LaunchShape& launch, RayTrails* trails);
  void reserve(uint64_t rays);
  uint32_t capacity() const { return rays_.capacity; }
  // Rays whose mark is not WT_NONE; leaves what trace() needs. One host read.
  uint32_t count(const RayQueue& rays, const gpu::Buffer<float>& marks);
  // The rays that count() has counted, more than none.
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
  gpu::Buffer<uint32_t> receptions_;  // scope = "all": of the marked rays
};

class CacheMisses {
 public:
  virtual ~CacheMisses() = default;
  // Makes room for queues of this many rays.
  virtual void reserve(uint64_t rays) { tracer_.reserve(rays); }
  uint32_t capacity() const { return tracer_.capacity(); }
  // The hits of the rays that are missed. Afterwards answers.missed marks those that were traced. now: the frame.
  virtual MissCounts find(const DeviceScene& scene, RayQueue& rays, HitList& hits, CacheTable& table, uint32_t now,
                          CacheAnswers& answers) = 0;

 protected:
  explicit CacheMisses(MissTracer tracer) : tracer_(std::move(tracer)) {}
  MissTracer tracer_;
};

// By cache.innerframe.
std::unique_ptr<CacheMisses> make_cache_misses(gpu::Context& context, const CacheTable& table, uint32_t static_surfaces,
                                               MissTracer tracer);

}  // namespace wavetracer
