// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/bounces.cl.
// A work-item takes one ray.
#include "passes/bounces.hpp"

#include <stdexcept>

#include "wavetracer/device/arguments.h"

namespace wavetracer {

Bounces::Bounces(gpu::Context& context, const DeviceScene& scene, bool ages, bool samples)
    : ages_(ages), samples_(samples), work_(tuning_of(context.info()).bounces) {
  gpu::Definitions definitions = scene.definitions;
  if (ages) definitions["WT_AGES"] = "1";
  if (samples) definitions["WT_SAMPLES"] = "1";
  kernel_ = {context, definitions};
}

void Bounces::operator()(const DeviceScene& scene, const RayQueue& rays, uint32_t interactions, const Trie& trie,
                         const gpu::Buffer<uint32_t>* ends) {
  if (ages_ && !trie.ages) throw std::logic_error("bounces: the set of sequences keeps no ages");
  if (samples_ && !ends) throw std::logic_error("bounces: there is no list for the ends of samples");
  if (interactions > WT_MAX_DEPTH) throw std::logic_error("bounces: more interactions than rays may have");
  kernel_(
      work_.range(rays.count), Stage::trace,
      calls::bounces::bounces{.nodes = scene.leg_nodes(),
                              .triangles = scene.leg_leaves(),
                              .moving = scene.moving,
                              .rays = rays.planes,
                              .surfaces = scene.surfaces,
                              .table = trie.table,
                              .quarters = trie.quarters,
                              .counters = trie.counters.buffer(),
                              .ages = trie.ages,
                              .ends = ends,
                              .args = wt_bounces_arguments{.triangle_slots = scene.triangle_slots,
                                                           .extent_m = scene.extent_m,
                                                           .capacity = rays.capacity,
                                                           .ray_count = rays.count,
                                                           .interactions = interactions,
                                                           .trie_mask = static_cast<uint32_t>(trie.table.size() - 1),
                                                           .now = trie.now}});
}

}  // namespace wavetracer
