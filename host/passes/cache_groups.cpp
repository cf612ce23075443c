// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/cache/cache_groups.cl.
// The table of ray numbers grows with the missed rays, and is emptied for each queue.
#include "passes/cache_groups.hpp"
#include "wavetracer/device/arguments.h"

#include <bit>
#include <stdexcept>

namespace wavetracer {

namespace {

constexpr Stage groups_stage = Stage::cache_groups;

// The size of the table, at least twice the rays, so that a search takes few steps; a power of two.
uint64_t places_for(uint64_t rays) { return std::bit_ceil(2 * rays); }

}  // namespace

CacheGroups::CacheGroups(gpu::Context& context, const CacheTable& table)
    : context_(context), work_(tuning_of(context.info()).cache_rays), words_(table.config.exact() ? 4 : 2) {
  gpu::Definitions definitions = table.definitions(false);
  definitions["WT_RAYS_PER_ITEM"] = work_.option();
  keys_ = {context, definitions};
  elect_ = {context, definitions};
  follow_ = {context, definitions};
  share_ = {context, definitions};
}

void CacheGroups::reserve(uint32_t capacity) {
  key_words_ = context_.buffer<uint64_t>(size_t{capacity} * words_, "keys of rays");
  numbers_ = context_.buffer<uint32_t>(places_for(capacity), "rays by the places of their keys");
  representatives_ = context_.buffer<uint32_t>(capacity, "representatives");
}

void CacheGroups::elect(const RayQueue& rays, gpu::Buffer<float>& missed, uint32_t missed_count,
                        const CacheTable& table, uint32_t static_surfaces) {
  const uint64_t places = places_for(missed_count);
  if (missed_count > rays.count || places > numbers_.size() || rays.count > representatives_.size())
    throw std::invalid_argument("cache_groups: no room for the rays");
  const uint32_t none = WT_NONE;
  context_.fill(numbers_, &none, sizeof none, 0, places * sizeof none, groups_stage);
  const gpu::Range range = work_.range(rays.count);
  keys_(range, groups_stage,
        calls::cache_groups::cache_keys{.rays = rays.planes,
                                        .capacity = rays.capacity,
                                        .count = rays.count,
                                        .missed = missed,
                                        .widths = table.widths,
                                        .static_surfaces = static_surfaces,
                                        .keys = key_words_,
                                        .places = representatives_});
  elect_(range, groups_stage,
         calls::cache_groups::cache_elect{.count = rays.count,
                                          .keys = key_words_,
                                          .table = numbers_,
                                          .mask = static_cast<uint32_t>(places - 1),
                                          .places = representatives_});
  follow_(range, groups_stage,
          calls::cache_groups::cache_follow{
              .count = rays.count, .missed = missed, .table = numbers_, .places = representatives_});
}

void CacheGroups::share(const CacheSurfaces& world, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
                        gpu::Buffer<float>& refused, CacheTable& table, uint32_t now,
                        gpu::Buffer<uint32_t>* receivers) {
  if (table.config.holds_all() && !receivers)
    throw std::invalid_argument("cache_groups: cache.scope = \"all\" without receivers");
  if (table.config.own_points() && !table.config.exact() && !world.surfaces)
    throw std::invalid_argument("cache_groups: no surfaces for cache.hit_point = \"own\"");
  share_(work_.range(rays.count), groups_stage,
         calls::cache_groups::cache_share{.rays = rays.planes,
                                          .hits = hits.planes,
                                          .missed = missed,
                                          .refused = refused,
                                          .representatives = representatives_,
                                          .entries = table.entries,
                                          .heads = table.heads,
                                          .used = table.used,
                                          .regions = table.device_regions,
                                          .counters = table.counters,
                                          .surfaces = world.surfaces,
                                          .receivers = receivers,
                                          .args = wt_cache_lookup_arguments{.capacity = rays.capacity,
                                                                            .count = rays.count,
                                                                            .now = now,
                                                                            .touch = 0,
                                                                            .static_surfaces = 0,
                                                                            .radius_m = 0,
                                                                            .widths = table.widths}});
}

}  // namespace wavetracer
