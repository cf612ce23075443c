// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/visible.cl.
// A work-item takes one solved path.
#include "passes/visible.hpp"

#include <algorithm>

#include "passes/growing_list.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_doubled = 1 << 22;  // paths

}  // namespace

Visible::Visible(gpu::Context& context, uint32_t max_depth)
    : context_(context), kernel_(context), local_(context.info().simple_local_size()) {
  visible_.max_depth = std::max(max_depth, 1u);
  visible_.counter = counter_word(&wt_counters::visible);
  visible_.reserve(context, 1 << 12);
}

void Visible::operator()(const SolvedList& solved, Counters& counters) {
  if (solved.count == 0) return;
  visible_.count = fill_list(
      counters, &wt_counters::visible, Stage::visible, [&] { return visible_.headers.size(); },
      [&] {
        kernel_({solved.count, local_}, Stage::visible,
                calls::visible::visible{.solved = solved.headers,
                                        .vertices = solved.vertices,
                                        .sequences = solved.sequences,
                                        .solved_count = solved.count,
                                        .solved_counter = solved.counter,
                                        .max_depth = solved.max_depth,
                                        .out = visible_.headers,
                                        .out_vertices = visible_.vertices,
                                        .out_sequences = visible_.sequences,
                                        .capacity = static_cast<uint32_t>(visible_.headers.size()),
                                        .counters = counters.buffer()});
      },
      [&](size_t rows) {
        SolvedList larger;
        larger.max_depth = visible_.max_depth;
        // Lists of few parts grow fast, because each growth copies them.
        larger.reserve(context_, std::max(rows, std::min(2 * visible_.headers.size(), most_doubled)));
        larger.copy_from(context_, visible_);
        visible_ = std::move(larger);
      },
      visible_.count);
}

}  // namespace wavetracer
