// Host side of kernels/interact.cl.
// On CPUs a work-item takes 64 blocks in turn, on GPUs one ray.
#include "passes/interact.hpp"

#include <string>

#include "passes/trace.hpp"

namespace wavetracer {

namespace {
constexpr uint32_t blocks_per_item = 64;
}

Interact::Interact(gpu::Context& context, bool keep_ages, bool samples, bool labels, bool transmission) {
  const uint32_t block = Trace::block_size(context.info());
  gpu::Definitions definitions{{"WT_BLOCK", std::to_string(block)},
                               {"WT_BLOCKS_PER_ITEM", std::to_string(blocks_per_item)}};
  if (keep_ages) definitions["WT_AGES"] = "1";
  if (samples) definitions["WT_SAMPLES"] = "1";
  if (labels) definitions["WT_LABELS"] = "1";
  kernel_ = context.kernel("interact", "interact", definitions);
  if (transmission) {
    definitions["WT_THROUGH"] = "1";
    kernel_through_ = context.kernel("interact", "interact", definitions);
  }
  rays_per_item_ = context.info().cpu ? block * blocks_per_item : 1;
  local_ = context.info().cpu ? 4 : block;
}

void Interact::operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                          gpu::Buffer<uint64_t>& trie, gpu::Buffer<uint32_t>& quarters,
                          gpu::Buffer<wt_counters>& counters, gpu::Buffer<uint32_t>& ages, uint32_t now, RayQueue& next,
                          bool last, const gpu::Buffer<uint32_t>* ends, RayQueue* through) {
  gpu::Kernel& kernel = through ? kernel_through_ : kernel_;
  kernel({(rays.count + rays_per_item_ - 1) / rays_per_item_, local_}, "interact", rays.planes, hits.planes,
         rays.capacity, rays.count, hits.block_hits, scene.surfaces, trie, static_cast<uint32_t>(trie.size() - 1),
         quarters, counters, next.planes, static_cast<uint32_t>(last), ages, now, ends ? *ends : ages,
         through ? through->planes : next.planes);
  if (!last) next.count = hit_count;
  if (through) through->count = hit_count;
}

}  // namespace wavetracer
