// SPDX-License-Identifier: Apache-2.0
// The sorts cross at one block of the bitonic one (passes/tuning.hpp), which is one launch and needs no temporary
// memory.
#include "passes/sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace wavetracer {

template <class Key>
KeySort<Key>::KeySort(gpu::Context& context, Payload payload, SortMethod method) {
  if (method != SortMethod::radix) bitonic_.emplace(context, payload);
  if (method != SortMethod::bitonic) radix_.emplace(context, payload);
}

template <class Key>
size_t KeySort<Key>::temporary_words(uint32_t n) const {
  const uint32_t networks = radix_ ? std::min(n, block()) : n;
  return std::max(bitonic_ ? bitonic_->temporary_words(networks) : 0, radix_ ? radix_->temporary_words(n) : 0);
}

template <class Key>
void KeySort<Key>::check_bits(unsigned first_bit, unsigned end_bit) const {
  if (first_bit > end_bit || end_bit > key_bits)
    throw std::invalid_argument(
        fmt::format("sort: bits {} to {} are no range of keys of {} bits", first_bit, end_bit, key_bits));
  if (!radix_ && (first_bit != 0 || end_bit != key_bits))
    throw std::invalid_argument(
        fmt::format("sort: bits {} to {} of keys of {} bits: the bitonic method sorts by all bits, radix by any range",
                    first_bit, end_bit, key_bits));
}

template <class Key>
bool KeySort<Key>::by_network(uint32_t n, unsigned first_bit, unsigned end_bit) const {
  check_bits(first_bit, end_bit);
  return !radix_ || (first_bit == 0 && end_bit == key_bits && n <= block());
}

template <class Key>
void KeySort<Key>::operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                              gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit, Stage stage) {
  if (by_network(n, first_bit, end_bit))
    (*bitonic_)(keys, values, n, temporary, stage);
  else
    (*radix_)(keys, values, n, temporary, first_bit, end_bit, stage);
}

template <class Key>
void KeySort<Key>::operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary, unsigned first_bit,
                              unsigned end_bit, Stage stage) {
  if (by_network(n, first_bit, end_bit))
    (*bitonic_)(keys, n, temporary, stage);
  else
    (*radix_)(keys, n, temporary, first_bit, end_bit, stage);
}

template class KeySort<uint32_t>;
template class KeySort<uint64_t>;

Sort::Sort(gpu::Context& context)
    : context_(context), sort_(context, Payload::index), temporary_(context.buffer<uint32_t>(1, "sort")) {}

void Sort::reserve(uint32_t n) {
  if (const size_t words = sort_.temporary_words(n); temporary_.size() < words)
    temporary_ = context_.buffer<uint32_t>(words, "sort");
}

void Sort::operator()(gpu::Buffer<uint32_t>& keys, gpu::Buffer<uint32_t>& order, uint32_t n, unsigned bits,
                      Stage stage) {
  if (temporary_.size() < sort_.temporary_words(n)) reserve(n + std::min(n / 4, ~n));  // they are often a few more next
  sort_(keys, order, n, temporary_, 0, n <= sort_.block() ? sort_.key_bits : bits, stage);
}

}  // namespace wavetracer
