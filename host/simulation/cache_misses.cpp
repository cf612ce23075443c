// SPDX-License-Identifier: Apache-2.0
// The host reads each count of rays once: the missed ones and, with groups, the leaders and those that were refused. A
// group's hit is shared by the rules of a look-up, so it may be refused with a quantised key, and never with an exact
// one.
#include "simulation/cache_misses.hpp"

namespace wavetracer {

namespace {

class EachMiss final : public CacheMisses {
 public:
  explicit EachMiss(MissTracer tracer) : CacheMisses(std::move(tracer)) {}

  MissCounts find(const DeviceScene& scene, RayQueue& rays, HitList& hits, CacheTable& table, uint32_t now,
                  CacheAnswers& answers) override {
    const uint32_t missed = tracer_.count(rays, answers.missed);
    if (missed > 0) tracer_.trace(scene, rays, hits, answers.missed, missed, table, now, answers);
    return {.traced = missed};
  }
};

class GroupedMisses final : public CacheMisses {
 public:
  GroupedMisses(gpu::Context& context, const CacheTable& table, uint32_t static_surfaces, MissTracer tracer)
      : CacheMisses(std::move(tracer)),
        context_(context),
        static_surfaces_(static_surfaces),
        groups_(context, table),
        may_refuse_(!table.config.exact() && (table.config.own_points() || table.config.by_precision())) {}

  void reserve(uint64_t rays) override {
    CacheMisses::reserve(rays);
    groups_.reserve(capacity());
    refused_ = context_.buffer<float>(capacity(), "refused rays");
  }

  MissCounts find(const DeviceScene& scene, RayQueue& rays, HitList& hits, CacheTable& table, uint32_t now,
                  CacheAnswers& answers) override {
    const uint32_t missed = tracer_.count(rays, answers.missed);
    if (missed == 0) return {};
    groups_.elect(rays, answers.missed, missed, table, static_surfaces_);
    const uint32_t groups = tracer_.count(rays, answers.missed);
    tracer_.trace(scene, rays, hits, answers.missed, groups, table, now, answers);
    if (groups == missed) return {.traced = missed, .groups = groups};
    groups_.share(scene, rays, hits, answers.missed, refused_, table, now,
                  answers.receivers ? &answers.receivers : nullptr);
    const uint32_t refused = may_refuse_ ? tracer_.count(rays, refused_) : 0;
    if (refused > 0) tracer_.trace(scene, rays, hits, refused_, refused, table, now, answers);
    return {.traced = groups + refused, .groups = groups, .shared = missed - groups - refused};
  }

 private:
  gpu::Context& context_;
  uint32_t static_surfaces_;
  CacheGroups groups_;
  bool may_refuse_;
  gpu::Buffer<float> refused_;
};

}  // namespace

MissTracer::MissTracer(gpu::Context& context, const DeviceScene& scene, const CacheTable& table,
                       uint32_t static_surfaces, TraceShape shape, const LaunchShape& launch, RayTrails* trails)
    : context_(context),
      static_surfaces_(static_surfaces),
      receives_(table.config.holds_all()),
      trails_(trails),
      compact_(context),
      scan_(context),
      gather_(context, Stage::cache_gather),
      trace_(context, scene, shape, launch, table.config.holds_all() ? Trace::Scope::all : Trace::Scope::fixed),
      store_(context, table) {}

void MissTracer::reserve(uint64_t rays) {
  rays_ = make_ray_queue(context_, rays, "missed rays", WT_RAY_ENTRY);
  hits_ = make_hit_list(context_, rays);
  blocks_ = context_.buffer<uint32_t>(compact_.blocks(rays_.capacity) + 1, "missed blocks");
  indices_ = context_.buffer<uint32_t>(rays_.capacity, "missed indices");
  if (!receives_) return;
  receptions_ = context_.buffer<uint32_t>(rays_.capacity, "receptions");
  context_.fill(receptions_, WT_NONE);  // keeps this value where receptions are not kept
}

uint32_t MissTracer::count(const RayQueue& rays, const gpu::Buffer<float>& marks) {
  compact_.count_blocks(marks, 0, rays.count, blocks_);
  return scan_(blocks_, compact_.blocks(rays.count));
}

void MissTracer::trace(const DeviceScene& scene, RayQueue& rays, HitList& hits, const gpu::Buffer<float>& marks,
                       uint32_t marked, CacheTable& table, uint32_t now, CacheAnswers& answers) {
  compact_(marks, 0, rays.count, blocks_, indices_);
  gather_(rays, indices_, marked, rays_);
  trace_(scene, rays_, hits_);
  if (trails_) trails_->first_receivers(rays_, hits_, receptions_);
  store_(scene, rays, rays_, hits_, indices_, hits, table, static_surfaces_, now, receives_ ? &receptions_ : nullptr,
         receives_ ? &answers.receivers : nullptr);
}

std::unique_ptr<CacheMisses> make_cache_misses(gpu::Context& context, const CacheTable& table, uint32_t static_surfaces,
                                               MissTracer tracer) {
  if (table.config.innerframe)
    return std::make_unique<GroupedMisses>(context, table, static_surfaces, std::move(tracer));
  return std::make_unique<EachMiss>(std::move(tracer));
}

}  // namespace wavetracer
