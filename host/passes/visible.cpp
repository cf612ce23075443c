// Host side of kernels/visible.cl.
// One solved path a work-item.
#include "passes/visible.hpp"

#include <algorithm>
#include <vector>

namespace wavetracer {

Visible::Visible(gpu::Context& context, uint32_t max_depth)
    : context_(context), kernel_(context.kernel("visible", "visible")), local_(context.info().simple_local_size()) {
  visible_.max_depth = std::max(max_depth, 1u);
  visible_.reserve(context, 1 << 12);
}

const SolvedList& Visible::operator()(const SolvedList& solved, gpu::Buffer<wt_counters>& counters) {
  for (;;) {
    kernel_({solved.count, local_}, "visible", solved.headers, solved.vertices, solved.sequences, solved.count,
            solved.max_depth, visible_.headers, visible_.vertices, visible_.sequences,
            static_cast<uint32_t>(visible_.headers.size()), counters);
    wt_counters now = counters.read_one(0, "visible");
    visible_.count = now.visible;
    if (now.visible <= visible_.headers.size()) return visible_;
    visible_.reserve(context_, size_t{now.visible} + now.visible / 4);
    now.visible = 0;
    counters.write(std::vector{now}, 0, "visible");
  }
}

}  // namespace wavetracer
