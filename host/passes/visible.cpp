// Host side of kernels/visible.cl.
// One solved path a work-item.
#include "passes/visible.hpp"

#include <algorithm>
#include <cstddef>

#include "passes/growing_list.hpp"

namespace wavetracer {

Visible::Visible(gpu::Context& context, uint32_t max_depth)
    : context_(context), kernel_(context.kernel("visible", "visible")), local_(context.info().simple_local_size()) {
  visible_.max_depth = std::max(max_depth, 1u);
  visible_.reserve(context, 1 << 12);
}

const SolvedList& Visible::operator()(const SolvedList& solved, gpu::Buffer<wt_counters>& counters) {
  zero_counter(context_, counters, offsetof(wt_counters, visible), "visible");
  visible_.count = fill_list(
      counters, &wt_counters::visible, "visible", [&] { return visible_.headers.size(); },
      [&] {
        kernel_({solved.count, local_}, "visible", solved.headers, solved.vertices, solved.sequences, solved.count,
                solved.max_depth, visible_.headers, visible_.vertices, visible_.sequences,
                static_cast<uint32_t>(visible_.headers.size()), counters);
      },
      [&](size_t rows) { visible_.reserve(context_, rows); });
  return visible_;
}

}  // namespace wavetracer
