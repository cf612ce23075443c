// Host side of kernels/candidates.cl.
// A work-item takes one sequence, on CPUs with all receivers, elsewhere with 16.
#include "passes/candidates.hpp"

#include "passes/growing_list.hpp"

namespace wavetracer {

Candidates::Candidates(gpu::Context& context, uint32_t max_reflections)
    : context_(context),
      kernel_(context.kernel("candidates", "candidates")),
      max_reflections_(max_reflections),
      list_(context.buffer<wt_candidate>(1 << 16, "candidates")) {}

uint32_t Candidates::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                                const gpu::Buffer<uint32_t>& nodes, uint32_t node_count,
                                gpu::Buffer<wt_counters>& counters) {
  if (ends.receiver_capacity == 0) return 0;
  const uint32_t groups = ends.receiver_capacity / 16, groups_per_item = context_.info().cpu ? groups : 1;
  return fill_list(
      counters, &wt_counters::candidates, "candidates", [&] { return list_.size(); },
      [&] {
        kernel_({size_t{node_count} * (groups / groups_per_item), 64}, "candidates", trie, nodes, node_count,
                ends.transmitters, scene.exact_surfaces, scene.surfaces, ends.receiver_planes, ends.links,
                ends.receiver_capacity, groups_per_item, ends.transmitter_count, max_reflections_, list_,
                static_cast<uint32_t>(list_.size()), counters);
      },
      [&](size_t entries) { list_ = context_.buffer<wt_candidate>(entries, "candidates"); });
}

}  // namespace wavetracer
