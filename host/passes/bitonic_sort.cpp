// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/primitives/bitonic_sort.cl.
// Strides of a block and more have launches of their own; the rest of each merge is one launch.
#include "passes/bitonic_sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

namespace wavetracer {

namespace {

// The most local memory that drivers keep for themselves.
constexpr uint64_t reserved_local_bytes = 1024;

uint32_t block_size(const gpu::DeviceInfo& device, size_t bytes_per_key, uint32_t largest_block) {
  if (largest_block < 16) throw std::invalid_argument(fmt::format("bitonic_sort: blocks of {} keys", largest_block));
  const uint64_t usable = device.local_memory - std::min(device.local_memory, reserved_local_bytes);
  return static_cast<uint32_t>(std::bit_floor(std::clamp<uint64_t>(usable / bytes_per_key, 16, largest_block)));
}

template <class Memory>
void require(const Memory& memory, size_t size, const char* what) {
  if (memory.size() >= size) return;
  throw std::invalid_argument(
      fmt::format("bitonic_sort: {} has {} elements, {} are needed", what, memory.size(), size));
}

}  // namespace

template <class Key>
BitonicSort<Key>::BitonicSort(gpu::Context& context, Payload payload, Form form, uint32_t largest_block)
    : payload_(payload),
      block_(
          block_size(context.info(), sizeof(Key) + (payload == Payload::none ? 0 : sizeof(uint32_t)), largest_block)) {
  const Tuning tuning = tuning_of(context.info());
  const bool vectors = form == Form::device ? tuning.alone : form == Form::vectors;
  items_ = vectors ? 1u : tuning.bitonic.items;
  step_group_ = tuning.bitonic.step_group;
  const gpu::Definitions definitions = {{"WT_KEY_BITS", std::to_string(8 * sizeof(Key))},
                                        {"WT_PAYLOAD", payload == Payload::none    ? "0"
                                                       : payload == Payload::words ? "1"
                                                                                   : "2"},
                                        {"WT_BLOCK", std::to_string(block_) + "u"},
                                        {"WT_LANES", vectors ? "16" : "1"}};
  sort_blocks_ = {context, definitions};
  one_step_ = {context, definitions};
  merge_blocks_ = {context, definitions};
  gather_ = {context, definitions};
}

template <class Key>
size_t BitonicSort<Key>::temporary_words(uint32_t n) const {
  return payload_ == Payload::words && n > block_ ? 2 * size_t{n} : 0;
}

template <class Key>
void BitonicSort<Key>::operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                                  gpu::Buffer<uint32_t>& temporary, Stage stage) {
  if (payload_ != Payload::none) require(values, n, "values");
  sort(keys, values, n, temporary, stage);
}

template <class Key>
void BitonicSort<Key>::operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary, Stage stage) {
  if (payload_ != Payload::none) throw std::invalid_argument("bitonic_sort: a sort with payload was given no values");
  sort(keys, temporary, n, temporary, stage);
}

template <class Key>
void BitonicSort<Key>::sort(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                            gpu::Buffer<uint32_t>& temporary, Stage stage) {
  require(keys, n, "keys");
  require(temporary, temporary_words(n), "temporary memory");
  if (n == 0) return;
  gpu::Buffer<uint32_t>& index = payload_ == Payload::index ? values : temporary;
  const size_t blocks = (size_t{n} + block_ - 1) / block_;
  // A small sort's barriers wait for at most as many work-items as it has comparators.
  const size_t items = std::min(items_, std::max(32u, std::bit_ceil(std::min(n, block_)) / 2));
  const size_t local = items_ == 1 ? 1 : items;
  sort_blocks_({blocks * local, local}, stage,
               calls::bitonic_sort::sort_blocks{.keys = keys, .values = values, .index = index, .n = n});
  // The last merge has groups of bit_ceil(n); a launch has as many comparators as whole groups do.
  for (uint64_t stride = block_; stride < n; stride *= 2) {
    const size_t comparators = (n + 2 * stride - 1) / (2 * stride) * stride;
    const size_t group = std::min<size_t>(step_group_, block_);
    one_step_({comparators, group}, stage,
              calls::bitonic_sort::one_step{.keys = keys,
                                            .index = index,
                                            .n = n,
                                            .stride = static_cast<uint32_t>(stride),
                                            .mask = static_cast<uint32_t>(2 * stride - 1)});
    for (uint64_t below = stride / 2; below >= block_; below /= 2)
      one_step_({comparators, group}, stage,
                calls::bitonic_sort::one_step{.keys = keys,
                                              .index = index,
                                              .n = n,
                                              .stride = static_cast<uint32_t>(below),
                                              .mask = static_cast<uint32_t>(below)});
    merge_blocks_({blocks * local, local}, stage,
                  calls::bitonic_sort::merge_blocks{.keys = keys, .index = index, .n = n});
  }
  if (payload_ == Payload::words && blocks > 1)
    gather_({n, step_group_}, stage, calls::bitonic_sort::gather{.values = values, .index = index, .n = n});
}

template class BitonicSort<uint32_t>;
template class BitonicSort<uint64_t>;

}  // namespace wavetracer
