// Host side of kernels/candidates.cl.
// A work-item takes one sequence with all receivers, or with 16.
#include "passes/candidates.hpp"

#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

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
  const Tuning tuning = tuning_of(context_.info());
  const uint32_t groups = ends.receiver_capacity / 16, groups_per_item = tuning.receivers_together ? groups : 1;
  return fill_list(
      counters, &wt_counters::candidates, "candidates", [&] { return list_.size(); },
      [&] {
        kernel_(tuning.candidates.range(size_t{node_count} * (groups / groups_per_item)), "candidates", trie, nodes,
                ends.transmitters, ends.receivers, scene.exact_surfaces, scene.surfaces, ends.receiver_planes,
                ends.links, list_, counters,
                wt_candidates_arguments{.node_count = node_count,
                                        .receiver_capacity = ends.receiver_capacity,
                                        .groups_per_item = groups_per_item,
                                        .transmitter_count = ends.transmitter_count,
                                        .max_reflections = max_reflections_,
                                        .capacity = static_cast<uint32_t>(list_.size())});
      },
      [&](size_t entries) { list_ = context_.buffer<wt_candidate>(entries, "candidates"); });
}

}  // namespace wavetracer
