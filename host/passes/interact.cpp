// Host side of kernels/interact.cl.
// On CPUs a work-item takes 64 blocks in turn, on GPUs one ray.
#include "passes/interact.hpp"

#include <stdexcept>
#include <string>

#include "passes/trace.hpp"

namespace wavetracer {

namespace {
constexpr uint32_t blocks_per_item = 64;
}

Interact::Interact(gpu::Context& context, InteractOptions options) : options_(options) {
  const uint32_t block = Trace::block_size(context.info());
  gpu::Definitions definitions{{"WT_BLOCK", std::to_string(block)},
                               {"WT_BLOCKS_PER_ITEM", std::to_string(blocks_per_item)}};
  if (options.ages) definitions["WT_AGES"] = "1";
  if (options.samples) definitions["WT_SAMPLES"] = "1";
  if (options.labels) definitions["WT_LABELS"] = "1";
  kernel_ = context.kernel("interact", "interact", definitions);
  if (options.transmission) {
    definitions["WT_THROUGH"] = "1";
    kernel_through_ = context.kernel("interact", "interact", definitions);
  }
  rays_per_item_ = context.info().cpu ? block * blocks_per_item : 1;
  local_ = context.info().cpu ? 4 : block;
}

void Interact::operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                          const Trie& trie, const RaysOnward& to) {
  if (options_.ages && !trie.ages) throw std::logic_error("interact: the set of sequences keeps no ages");
  if (options_.samples && !to.ends) throw std::logic_error("interact: there is no list for the ends of samples");
  if (to.transmitted && !options_.transmission) throw std::logic_error("interact: it was made without transmission");
  gpu::Kernel& kernel = to.transmitted ? kernel_through_ : kernel_;
  const auto planes = [](const RayQueue* queue) { return queue ? &queue->planes : nullptr; };
  kernel({(rays.count + rays_per_item_ - 1) / rays_per_item_, local_}, "interact", rays.planes, hits.planes,
         rays.capacity, rays.count, hits.block_hits, scene.surfaces, trie.table,
         static_cast<uint32_t>(trie.table.size() - 1), trie.quarters, trie.counters, planes(to.reflected),
         static_cast<uint32_t>(!to.reflected), trie.ages, trie.now, to.ends, planes(to.transmitted));
  for (RayQueue* const queue : {to.reflected, to.transmitted})
    if (queue) queue->count = hit_count;
}

}  // namespace wavetracer
