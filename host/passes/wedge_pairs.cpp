// Host side of kernels/wedge_pairs.cl.
#include "passes/wedge_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "passes/tuning.hpp"

namespace wavetracer {
namespace {

size_t words_of(uint64_t wedges) { return wedges * wedges / 2 + 1; }

// The bits of known pairs may take this much memory, 32,000 wedges. Of more, which are corners first, each frame finds
// it out again.
uint32_t kept_wedges(const gpu::DeviceInfo& device, uint64_t wedges) {
  const uint64_t most = std::min({uint64_t{1} << 31, device.max_buffer, device.global_memory / 16});
  const auto room = static_cast<uint64_t>(std::sqrt(static_cast<double>(most) / 2 - 2));  // words_of(room) fit
  return static_cast<uint32_t>(std::min(wedges, room));
}

}  // namespace

WedgePairs::WedgePairs(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission)
    : sight(context, device_scene, scene, transmission),
      kernel_(context.kernel("wedge_pairs", "wedge_pairs", device_scene.definitions)),
      group_(tuning_of(context.info()).pairs_group),
      kept_wedges_(kept_wedges(context.info(), scene.wedges.size())),
      kept_(context.buffer<uint32_t>(words_of(kept_wedges_), "pairs of wedges")) {
  const wt_uint zero = 0;
  context.fill(kept_, &zero, sizeof zero, 0, kept_.size() * sizeof zero, Stage::wedge_pairs);
}

void WedgePairs::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                            const RadioEnds& ends, const gpu::Buffer<uint32_t>& receiver_of_origin,
                            const wt_wedge_join_arguments& join, gpu::Buffer<wt_wedge_candidate>& list,
                            Counters& counters) {
  kernel_({size_t{join.end - join.first} * join.lanes, group_}, Stage::wedge_pairs, scene.leg_nodes(),
          scene.leg_leaves(), scene.exact_surfaces, sight.first_sides(), sight.sides(), kept_, prefixes.keys,
          prefixes.order, prefixes.prefixes, receiver_of_origin, ends.links, wedges.wedges, scene.surfaces, list,
          counters.buffer(), join, sight.arguments(scene, join.count, kept_wedges_));
}

}  // namespace wavetracer
