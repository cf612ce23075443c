// SPDX-License-Identifier: Apache-2.0
// The sorts cross at one block of the bitonic one (passes/tuning.hpp), which is one launch and needs no temporary
// memory.
#include "passes/sort.hpp"

#include <algorithm>

namespace wavetracer {

Sort::Sort(gpu::Context& context)
    : context_(context),
      bitonic_(context, Payload::index),
      radix_(context, Payload::index),
      temporary_(context.buffer<uint32_t>(1, "sort")) {}

size_t Sort::words(uint32_t n) const {
  const size_t few = bitonic_.temporary_words(std::min(n, bitonic_.block()));
  return n <= bitonic_.block() ? few : std::max(few, radix_.temporary_words(n));
}

void Sort::reserve(uint32_t n) {
  if (temporary_.size() < words(n)) temporary_ = context_.buffer<uint32_t>(words(n), "sort");
}

void Sort::operator()(gpu::Buffer<uint32_t>& keys, gpu::Buffer<uint32_t>& order, uint32_t n, unsigned bits,
                      Stage stage) {
  if (temporary_.size() < words(n)) reserve(n + std::min(n / 4, ~n));  // they are often a few more the next time
  if (n <= bitonic_.block())
    bitonic_(keys, order, n, temporary_, stage);
  else
    radix_(keys, order, n, temporary_, 0, bits, stage);
}

}  // namespace wavetracer
