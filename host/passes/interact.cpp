// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/interact.cl.
// A work-item takes a run of blocks (CPUs), or a ray, and then a group takes a block.
#include "passes/interact.hpp"

#include <stdexcept>
#include <string>

#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Interact::Interact(gpu::Context& context, InteractOptions options) : options_(options) {
  const Tuning tuning = tuning_of(context.info());
  gpu::Definitions definitions{{"WT_BLOCK", std::to_string(tuning.block)},
                               {"WT_BLOCKS_PER_ITEM", std::to_string(tuning.blocks_per_item)}};
  if (options.ages) definitions["WT_AGES"] = "1";
  if (options.samples) definitions["WT_SAMPLES"] = "1";
  if (options.labels) definitions["WT_LABELS"] = "1";
  kernel_ = {context, definitions};
  if (options.transmission) {
    definitions["WT_THROUGH"] = "1";
    kernel_through_ = {context, definitions};
  }
  work_ = tuning.blocks;
}

void Interact::operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                          const Trie& trie, const RaysOnward& to) {
  if (options_.ages && !trie.ages) throw std::logic_error("interact: the set of sequences keeps no ages");
  if (options_.samples && !to.ends) throw std::logic_error("interact: there is no list for the ends of samples");
  if (to.transmitted && !options_.transmission) throw std::logic_error("interact: it was made without transmission");
  auto& kernel = to.transmitted ? kernel_through_ : kernel_;
  const auto planes = [](const RayQueue* queue) { return queue ? &queue->planes : nullptr; };
  kernel(
      work_.range(rays.count), Stage::interact,
      calls::interact::interact{.rays = rays.planes,
                                .hits = hits.planes,
                                .block_offsets = hits.block_hits,
                                .surfaces = scene.surfaces,
                                .table = trie.table,
                                .quarters = trie.quarters,
                                .counters = trie.counters.buffer(),
                                .next = planes(to.reflected),
                                .ages = trie.ages,
                                .ends = to.ends,
                                .through = planes(to.transmitted),
                                .args = wt_interact_arguments{.capacity = rays.capacity,
                                                              .ray_count = rays.count,
                                                              .trie_mask = static_cast<uint32_t>(trie.table.size() - 1),
                                                              .last = !to.reflected,
                                                              .now = trie.now}});
  for (RayQueue* const queue : {to.reflected, to.transmitted})
    if (queue) queue->count = hit_count;
}

}  // namespace wavetracer
