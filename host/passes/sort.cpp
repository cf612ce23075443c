// Where the sorts cross. Set to what bench_sort prints; it prints both sorts at sizes around it.
// GPUs: fewer launches outweigh more work up to there; CPUs: one launch in vectors.
#include "passes/sort.hpp"

#include <algorithm>

namespace wavetracer {

Sort::Sort(gpu::Context& context)
    : bitonic_(context, Payload::index), radix_(context, Payload::index), bitonic_most_(bitonic_.block()) {}

size_t Sort::temporary_words(uint32_t n) const {
  return std::max(bitonic_.temporary_words(std::min(n, bitonic_most_)), radix_.temporary_words(n));
}

void Sort::operator()(gpu::Buffer<uint32_t>& keys, gpu::Buffer<uint32_t>& order, uint32_t n,
                      gpu::Buffer<uint32_t>& temporary, unsigned bits) {
  if (n <= bitonic_most_)
    bitonic_(keys, order, n, temporary);
  else
    radix_(keys, order, n, temporary, 0, bits);
}

}  // namespace wavetracer
