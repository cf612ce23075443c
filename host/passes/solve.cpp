// Host side of kernels/solve.cl.
// One candidate a work-item.
#include "passes/solve.hpp"

#include <algorithm>
#include <vector>

namespace wavetracer {

Solve::Solve(gpu::Context& context, uint32_t max_depth) : context_(context), kernel_(context.kernel("solve", "solve")) {
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.reserve(context, 1 << 14);
}

SolvedList& Solve::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                              const gpu::Buffer<wt_candidate>& candidates, uint32_t candidate_count,
                              gpu::Buffer<wt_counters>& counters) {
  for (;;) {
    kernel_({candidate_count, 16}, "solve", trie, ends.transmitters, ends.receivers, scene.exact_surfaces,
            scene.exact_triangles, scene.exact_instances, candidates, candidate_count,
            solved_.max_depth, solved_.headers, solved_.vertices, solved_.sequences, static_cast<uint32_t>(solved_.headers.size()), counters);
    wt_counters now = counters.read_one(0, "solve");
    solved_.count = now.solved;
    if (now.solved <= solved_.headers.size()) return solved_;
    solved_.reserve(context_, size_t{now.solved} + now.solved / 4);
    now.solved = 0;
    counters.write(std::vector{now}, 0, "solve");
  }
}

}  // namespace wavetracer
