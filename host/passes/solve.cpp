// Host side of kernels/solve.cl.
// One candidate per work-item.
#include "passes/solve.hpp"

#include <algorithm>

#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Solve::Solve(gpu::Context& context, uint32_t max_depth)
    : context_(context), work_(tuning_of(context.info()).exact), kernel_(context.kernel("solve", "solve")) {
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.reserve(context, 1 << 14);
}

SolvedList& Solve::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                              const gpu::Buffer<uint32_t>& quarters, const gpu::Buffer<wt_candidate>& candidates,
                              uint32_t candidate_count, gpu::Buffer<wt_counters>& counters) {
  solved_.count = fill_list(
      counters, &wt_counters::solved, "solve", [&] { return solved_.headers.size(); },
      [&] {
        kernel_(work_.range(candidate_count), "solve", trie, quarters, ends.transmitters, ends.receivers,
                scene.exact_surfaces, scene.exact_triangles, scene.exact_instances, candidates, solved_.headers,
                solved_.vertices, solved_.sequences, counters,
                wt_solve_arguments{candidate_count, solved_.max_depth, static_cast<uint32_t>(solved_.headers.size())});
      },
      [&](size_t rows) { solved_.reserve(context_, rows); });
  return solved_;
}

}  // namespace wavetracer
