// SPDX-License-Identifier: Apache-2.0
// The public face of the pass Compact, with the scan between its two operations.
// The pass takes planes of rays, whose words are bits of floats.
#include "wavetracer/kernels/compact.hpp"

#include "kernel_suite/state.hpp"
#include "passes/compact.hpp"
#include "passes/scan.hpp"

namespace wavetracer::kernels {

static_assert(nothing == WT_NONE);

namespace {

constexpr const char* compact_name = "Compact";

}  // namespace

struct Compact::State : PassState {
  explicit State(const Context& of) : PassState(of), compact(context->gpu), scan(context->gpu) {}
  wavetracer::Compact compact;
  wavetracer::Scan scan;
  gpu::Buffer<uint32_t> blocks;

  void make_room(uint32_t n) {
    if (const size_t needed = compact.blocks(n); blocks.size() < needed)
      blocks = context->gpu.buffer<uint32_t>(needed, "blocks of a compaction");
  }
};

Compact::Compact(const Context& context) : state_(with_errors([&] { return std::make_unique<State>(context); })) {}
Compact::~Compact() = default;
Compact::Compact(Compact&&) noexcept = default;
Compact& Compact::operator=(Compact&&) noexcept = default;

void Compact::operator()(const Buffer<uint32_t>& words, size_t n, const Buffer<uint32_t>& indices,
                         const Buffer<uint32_t>& total, const Call& call) {
  const uint32_t count = count_of(compact_name, n);
  const gpu::Buffer<float> plane(memory_of(*state_, compact_name, "words", words, 4 * n));
  gpu::Buffer<uint32_t> places = buffer_of(*state_, compact_name, "indices", indices, n);
  gpu::Buffer<uint32_t> sum = buffer_of(*state_, compact_name, "total", total, 1);
  with_errors([&] { state_->make_room(count); });
  enqueue(*state_, call, [&] {
    state_->compact.count_blocks(plane, 0, count, state_->blocks);
    state_->scan.prefix(state_->blocks, state_->compact.blocks(count), sum);
    state_->compact(plane, 0, count, state_->blocks, places);
  });
}

void Compact::reserve(size_t n) {
  with_errors([&] { state_->make_room(count_of(compact_name, n)); });
}

}  // namespace wavetracer::kernels
