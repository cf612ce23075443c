// SPDX-License-Identifier: Apache-2.0
// The ray cache in a frame: it answers rays of a depth, traces the others, and keeps their hits; each transmitter has a
// region. Entries contain hits on the static scene only (cache.scope = "static"), or on everything, as in the thesis
// ("all").
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "passes/cache_lookup.hpp"
#include "passes/cache_positions.hpp"
#include "passes/cache_purge.hpp"
#include "passes/trace_moving.hpp"
#include "simulation/cache_misses.hpp"
#include "simulation/hit_finder.hpp"
#include "simulation/ray_trails.hpp"
#include "simulation/world.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// The data of the world that a cache needs besides the scene on the device.
struct CacheWorld {
  uint32_t transmitters = 0;
  uint32_t surfaces = 0, primitives = 0;  // numbers in the whole world
  uint32_t static_surfaces = 0;
  uint32_t instances = 0;
};

// config: has the features of its run (feature_choice.hpp). Throws ConfigError if cache.buffer_size is too small for
// all that launch rays in this world. It needs no device.
void check_cache(const Config& config, const World& world);

CacheWorld cache_world(const Scene& scene, const World& world, uint32_t transmitters);

// With trace.reception = "sphere" and cache.scope = "all", entries name the receiver whose sphere their segment passed
// first, as in the thesis.
struct CachedReception {
  RayTrails* trails = nullptr;  // outlives the cache
  double radius_m = 0;
};

class RayCache final : public HitFinder {
 public:
  // shape, launch: the way in which missed rays are traced. Throws ConfigError if the table does not fit.
  RayCache(gpu::Context& context, const DeviceScene& scene, const CacheConfig& config, const CacheWorld& world,
           TraceShape shape, const LaunchShape& launch, CachedReception reception = {});
  void reserve(uint64_t rays) override;
  // Is it the thesis' table with its faults, whose answers may be those of other keys?
  bool as_printed() const { return table_.config.as_printed(); }
  // Removes everything: the next frame meets an empty table.
  void clear();
  // Begins a frame: purges regions of transmitters that have moved away and, if room is short, unused entries.
  void begin_frame(const WorldState& world);
  void find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) override;
  // The answered rays, with their receivers where receptions are kept.
  std::optional<AnsweredRays> answered(uint32_t depth) const override;
  void count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) override;
  // Adds the present entries of the table, for frame `frame`; reads the device. Needs cache.statistics.
  void add_entries(uint32_t frame, CacheEntryRows& rows) const;
  // The counts of the frame so far; reads the device.
  CacheSummary summary();

 private:
  bool asked(uint32_t depth) const { return depth >= table_.config.first_depth; }
  void purge();
  void account(uint32_t depth, uint64_t lookups, const MissCounts& misses);
  void note_positions(const std::vector<EndState>& transmitters);
  void note_movement(std::span<const Placement> instances);
  void note_receivers(const std::vector<EndState>& receivers);
  std::vector<uint64_t> entries_by_hits() const;

  gpu::Context& context_;
  CacheTable table_;
  CacheMovement movement_;
  CacheLookup lookup_;
  CachePurge purge_;
  RayTrails* trails_;  // set where receptions are kept, else null
  std::unique_ptr<CacheMisses> misses_;
  Compact compact_;
  TracedHits traced_;  // used before cache.first_depth
  std::optional<TraceMoving> trace_moving_;
  uint32_t static_surfaces_, frame_ = 0;
  CacheAnswers answers_;
  bool touch_ = false;
  CachePositions positions_;              // one for each transmitter
  std::vector<Placement> placements_;     // places of instances when they last counted as moved
  std::vector<uint32_t> instance_since_;  // frame of that movement
  std::vector<uint32_t> used_;            // entries of each region at the end of the last frame
  device::wt_cache_counters counters_{};  // those of the last frame
  CacheSummary frame_summary_;
};

}  // namespace wavetracer
