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

void Visible::clear(gpu::Buffer<wt_counters>& counters) {
  zero_counter(context_, counters, offsetof(wt_counters, visible), "visible");
  visible_.count = 0;
}

void Visible::operator()(const SolvedList& solved, gpu::Buffer<wt_counters>& counters) {
  if (solved.count == 0) return;
  wt_counters now{};
  visible_.count = grow_until_filled(
      [&] {
        kernel_({solved.count, local_}, "visible", solved.headers, solved.vertices, solved.sequences, solved.count,
                solved.max_depth, visible_.headers, visible_.vertices, visible_.sequences,
                static_cast<uint32_t>(visible_.headers.size()), counters);
      },
      [&] { return (now = counters.read_one(0, "visible")).visible; }, [&] { return visible_.headers.size(); },
      [&](size_t rows) {
        SolvedList larger;
        larger.max_depth = visible_.max_depth;
        larger.reserve(context_, rows);
        larger.copy_from(context_, visible_);
        visible_ = std::move(larger);
        now.visible = visible_.count;
        counters.write(std::vector{now}, 0, "visible");
      });
}

}  // namespace wavetracer
