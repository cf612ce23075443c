// SPDX-License-Identifier: Apache-2.0
// The host keeps stamps and evicts; the device answers. The host reads two numbers at each depth: the rays that were
// not answered, and (in the caller) those that hit; with cache.innerframe one or two more.
#include "simulation/ray_cache.hpp"
#include "simulation/cache_entries.hpp"

#include <algorithm>
#include <bit>
#include <ranges>
#include <stdexcept>

#include "passes/cache_table.hpp"
#include "simulation/listeners.hpp"

namespace wavetracer {

namespace {

// Shares of a region's entries: above the first, look-ups record the use of entries; above the second, unused entries
// are removed.
constexpr double filling = 0.7, full = 0.8;

bool moved(const Placement& a, const Placement& b, double step_m) {
  constexpr double turn = 1e-3;  // in a matrix element: a millimetre at a metre
  if (a.present != b.present || glm::length(a.position_m - b.position_m) > step_m) return true;
  for (int column = 0; column < 3; ++column)
    if (glm::length(a.rotation[column] - b.rotation[column]) > turn) return true;
  return false;
}

}  // namespace

void check_cache(const Config& config, const World& world) {
  if (!config.cache.on()) return;
  check_cache_share(config.cache, make_origins(world.twins.receiver_of_transmitter, world.twins.transmitter_of_receiver,
                                               config.trace.from_both_ends())
                                      .count());
}

CacheWorld cache_world(const Scene& scene, const World& world, uint32_t transmitters) {
  CacheWorld out{.transmitters = transmitters,
                 .surfaces = static_cast<uint32_t>(scene.surfaces.size()),
                 .primitives = static_cast<uint32_t>(scene.triangles.size()),
                 .static_surfaces = static_cast<uint32_t>(scene.surfaces.size()),
                 .instances = static_cast<uint32_t>(world.fleet.instances.size())};
  for (const Instance& instance : world.fleet.instances) {
    const Scene& model = world.fleet.models[instance.model];
    out.surfaces += static_cast<uint32_t>(model.surfaces.size());
    out.primitives += static_cast<uint32_t>(model.triangles.size());
  }
  return out;
}

RayCache::RayCache(gpu::Context& context, const DeviceScene& scene, const CacheConfig& config, const CacheWorld& world,
                   TraceShape shape, const LaunchShape& launch, CachedReception reception)
    : context_(context),
      table_(make_cache_table(context, config, world.transmitters, world.surfaces, world.primitives)),
      movement_(make_cache_movement(context)),
      lookup_(context, table_),
      purge_(context, table_),
      trails_(config.holds_all() ? reception.trails : nullptr),
      misses_(make_cache_misses(context, table_, world.static_surfaces,
                                {context, scene, table_, world.static_surfaces, shape, launch, trails_})),
      compact_(context),
      traced_(context, scene, shape, launch),
      static_surfaces_(world.static_surfaces),
      positions_(world.transmitters),
      instance_since_(world.instances),
      used_(world.transmitters) {
  if (world.instances > 0 && !config.holds_all()) trace_moving_.emplace(context, scene);
  if (world.instances > 0) movement_.instance_since = context.buffer(instance_since_, "instances moved");
  if (trails_) movement_.radius_m = static_cast<float>(reception.radius_m);
}

std::optional<AnsweredRays> RayCache::answered(uint32_t depth) const {
  if (!asked(depth)) return {};
  return AnsweredRays{answers_.missed, trails_ ? &answers_.receivers : nullptr, table_.config.holds_all()};
}

void RayCache::count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) {
  if (asked(depth))
    compact_.count_blocks(hits.planes, size_t{WT_HIT_SURFACE} * hits.capacity, rays.count, hits.block_hits);
  else
    traced_.count_blocks(rays, hits, depth);
}

void RayCache::clear() {
  table_.clear(context_);
  std::ranges::fill(used_, 0u);
  placements_.clear();
  counters_ = {};
  touch_ = false;
}

void RayCache::begin_frame(const WorldState& world) {
  ++frame_;
  frame_summary_ = {};
  frame_summary_.on = true;
  table_.counters.write(std::vector<device::wt_cache_counters>(1), 0, Stage::cache_purge);
  if (touch_) purge();
  touch_ = table_.config.evicts() && std::ranges::any_of(std::views::iota(size_t{0}, used_.size()), [this](size_t r) {
             return used_[r] > filling * table_.regions[r].entries;
           });
  note_positions(world.transmitters);
  note_movement(world.instances);
  note_receivers(world.receivers);
}

// Removes entries that no ray of the last frame used, where a region is nearly full.
void RayCache::purge() {
  bool wanted = table_.config.pooled() && counters_.exhausted > 0;
  for (size_t r = 0; r < used_.size(); ++r) wanted = wanted || used_[r] > full * table_.regions[r].entries;
  if (wanted) purge_(context_, table_, frame_ - 1);
}

// Algorithm 3: entries from before the transmitter's position key changed are stale.
void RayCache::note_positions(const std::vector<EndState>& transmitters) {
  const CacheConfig& config = table_.config;
  if (!config.by_position()) return;
  bool changed = false;
  for (uint32_t r = 0; r < used_.size(); ++r) {
    if (!positions_.note(table_, r, transmitters[r].position_m, frame_)) continue;
    changed = true;
    if (!config.evicts() || used_[r] == 0) continue;  // an open table writes over stale entries
    frame_summary_.evicted += used_[r];
    table_.clear(context_, r);
  }
  if (changed) table_.device_regions.write(table_.regions, 0, Stage::cache_purge);
}

// Section 3.2.3, movement of objects: entries on instances that have moved are stale.
void RayCache::note_movement(std::span<const Placement> instances) {
  if (!table_.config.holds_all() || instances.empty()) return;
  const bool first = placements_.empty();
  placements_.resize(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    if (!first && !moved(instances[i], placements_[i], table_.config.position_step_m)) continue;
    instance_since_[i] = frame_;
    placements_[i] = instances[i];
  }
  movement_.instance_since.write(instance_since_, 0, Stage::cache_purge);
}

// Algorithm 4: entries say which receiver they reach, and are valid while they reach it.
void RayCache::note_receivers(const std::vector<EndState>& receivers) {
  if (!trails_) return;
  std::vector<float> centres;
  for (const EndState& end : receivers)
    for (const double x : {end.position_m.x, end.position_m.y, end.position_m.z, 0.0})
      centres.push_back(static_cast<float>(x));
  if (movement_.receivers.size() != centres.size())
    movement_.receivers = context_.buffer(centres, "receivers");
  else
    movement_.receivers.write(centres, 0, Stage::cache_purge);
}

void RayCache::reserve(uint64_t rays) {
  misses_->reserve(rays);
  answers_.missed = context_.buffer<float>(misses_->capacity(), "missed");
  if (table_.config.holds_all())
    answers_.receivers = context_.buffer<uint32_t>(misses_->capacity(), "cached receptions");
}

void RayCache::find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) {
  if (!asked(depth)) return traced_.find(scene, rays, hits, depth);
  if (rays.capacity != misses_->capacity()) throw std::logic_error("ray_cache: no room for the rays");
  lookup_(scene, rays, hits, answers_.missed, table_, movement_, static_surfaces_, frame_, touch_,
          answers_.receivers ? &answers_.receivers : nullptr);
  account(depth, rays.count, misses_->find(scene, rays, hits, table_, frame_, answers_));
  if (trace_moving_) (*trace_moving_)(scene, rays, hits);
}

void RayCache::account(uint32_t depth, uint64_t lookups, const MissCounts& misses) {
  CacheSummary& s = frame_summary_;
  const uint64_t hits = lookups - misses.traced - misses.shared;
  s.lookups_per_depth.resize(std::max<size_t>(s.lookups_per_depth.size(), depth));
  s.hits_per_depth.resize(s.lookups_per_depth.size());
  s.shared_per_depth.resize(s.lookups_per_depth.size());
  s.lookups_per_depth[depth - 1] += lookups;
  s.hits_per_depth[depth - 1] += hits;
  s.shared_per_depth[depth - 1] += misses.shared;
  s.lookups += lookups;
  s.hits += hits;
  s.traced += misses.traced;
  s.groups += misses.groups;
  s.shared += misses.shared;
}

CacheSummary RayCache::summary() {
  counters_ = table_.counters.read_one(0, Stage::cache_purge);
  used_ = table_.used.read(0, used_.size(), Stage::cache_purge);
  // The chained table counts what it would have handed out.
  for (size_t r = 0; r < used_.size(); ++r) used_[r] = std::min(used_[r], table_.regions[r].entries);
  CacheSummary s = frame_summary_;
  s.conflicts = counters_.conflicts;
  s.stale = counters_.stale;
  s.stored = counters_.stored;
  s.replaced = counters_.replaced;
  s.duplicates = counters_.duplicates;
  s.dropped = counters_.dropped;
  s.exhausted = counters_.exhausted;
  s.evicted += counters_.evicted;
  s.linked = counters_.linked;
  for (const device::wt_cache_region& region : table_.regions) s.entries += region.entries;
  for (const uint32_t used : used_) s.used += used;
  s.bytes = table_.bytes();
  if (table_.config.statistics) s.entries_by_hits = entries_by_hits();
  return s;
}

void RayCache::add_entries(uint32_t frame, CacheEntryRows& rows) const {
  add_cache_entries(table_, frame, frame_, rows);
}

// The groups are 0, 1, 2, 3 to 4, 5 to 8, ... answers, of entries that were written.
std::vector<uint64_t> RayCache::entries_by_hits() const {
  const std::vector<uint32_t> hits = table_.hits.read(0, table_.hits.size(), Stage::cache_purge);
  std::vector<uint64_t> groups;
  uint64_t answering = 0, written = 0;
  for (const uint32_t count : hits) {
    if (count == 0) continue;
    const auto group = static_cast<size_t>(count == 1 ? 1 : 1 + std::bit_width(count - 1));
    groups.resize(std::max(groups.size(), group + 1));
    ++groups[group];
    ++answering;
  }
  for (const uint32_t used : used_) written += used;
  groups.resize(std::max<size_t>(groups.size(), 1));
  groups[0] = written - std::min(written, answering);
  return groups;
}

}  // namespace wavetracer
