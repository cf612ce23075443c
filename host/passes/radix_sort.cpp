// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/primitives/radix_sort.cl (groups) and radix_sort_cpu.cl (chunks), which have the same kernels.
// Temporary memory has the layout of kernels/lib/radix.clh.
#include "passes/radix_sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "kernel_calls/radix_sort_cpu.hpp"

namespace wavetracer {

namespace {

// Both programs have the same kernels.
static_assert(calls::radix_sort::count::declared == calls::radix_sort_cpu::count::declared);
static_assert(calls::radix_sort::offsets::declared == calls::radix_sort_cpu::offsets::declared);
static_assert(calls::radix_sort::move::declared == calls::radix_sort_cpu::move::declared);
static_assert(calls::radix_sort::settle::declared == calls::radix_sort_cpu::settle::declared);

constexpr uint32_t flag_words = 16;  // WT_MAX_PASSES
constexpr uint32_t line_words = 16;  // keys and values of the temporary memory begin at multiples of this

uint32_t ceil_divide(uint32_t a, uint32_t b) { return a / b + (a % b != 0); }

void require(const char* what, size_t has, size_t needs, uint32_t n) {
  if (has >= needs) return;
  throw std::invalid_argument(
      fmt::format("radix_sort: {} has {} elements, {} are needed to sort {} keys", what, has, needs, n));
}

}  // namespace

template <class Key>
RadixSort<Key>::RadixSort(gpu::Context& context, Payload payload, SortForm form) : payload_(payload) {
  const uint32_t value_bytes = payload == Payload::none ? 0 : 4;
  if (form == SortForm::device) form = tuning_of(context.info()).alone ? SortForm::chunks : SortForm::groups;
  if (form == SortForm::groups) {
    *this = RadixSort(context, payload, radix_groups(context.info(), sizeof(Key), value_bytes));
    return;
  }
  tuning_ = radix_chunks(context.info());
  const uint64_t keys = form == SortForm::lines ? 0 : tuning_.direct_bytes / (sizeof(Key) + value_bytes);
  make_kernels(context, "radix_sort_cpu", {{"WT_SCATTER_KEYS", std::to_string(keys) + "u"}});
}

template <class Key>
RadixSort<Key>::RadixSort(gpu::Context& context, Payload payload, const RadixTuning& groups)
    : payload_(payload), tuning_(groups) {
  make_kernels(context, "radix_sort",
               {{"WT_ITEMS", std::to_string(groups.items)},
                {"WT_TILE", std::to_string(groups.tile)},
                {"WT_OFFSET_ITEMS", std::to_string(groups.offset_items)},
                {"WT_COLUMNS", std::to_string(groups.columns)},
                {"WT_TOGETHER", groups.together ? "1" : "0"},
                {"WT_LATE_VALUES", groups.late_values ? "1" : "0"}});
}

template <class Key>
void RadixSort<Key>::make_kernels(gpu::Context& context, const char* program, gpu::Definitions definitions) {
  definitions["WT_KEY"] = sizeof(Key) == 4 ? "uint" : "ulong";
  definitions["WT_PAYLOAD"] = std::to_string(static_cast<int>(payload_));
  definitions["WT_DIGIT_BITS"] = std::to_string(tuning_.digit_bits);
  count_ = {context, definitions, program};
  offsets_ = {context, definitions, program};
  move_ = {context, definitions, program};
  settle_ = {context, definitions, program};
}

template <class Key>
uint32_t RadixSort<Key>::chunk_of(uint32_t n) const {
  return tuning_.tile * std::max(1u, ceil_divide(ceil_divide(n, tuning_.tile), tuning_.most_chunks));
}

template <class Key>
size_t RadixSort<Key>::temporary_words(uint32_t n) const {
  const size_t lines = (size_t{n} + line_words - 1) / line_words * line_words;
  const size_t tiles = tuning_.moves_tiles ? ceil_divide(n, tuning_.tile) : 0;
  // This is not ceil(n / chunk): that may be more for fewer keys, and a buffer for n keys must suffice for them, too.
  const size_t chunks = std::min(ceil_divide(n, tuning_.tile), tuning_.most_chunks);
  const size_t counts = (1 + chunks + tiles) << tuning_.digit_bits;
  return flag_words + counts + lines * (sizeof(Key) / 4 + (payload_ == Payload::none ? 0 : 1));
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                                gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit, Stage stage) {
  if (payload_ != Payload::none) require("values", values.size(), n, n);
  sort(keys, values, n, temporary, first_bit, end_bit, stage);
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                                unsigned first_bit, unsigned end_bit, Stage stage) {
  if (payload_ != Payload::none) throw std::logic_error("radix_sort: a sort with a payload was given no values");
  sort(keys, temporary, n, temporary, first_bit, end_bit, stage);
}

template <class Key>
void RadixSort<Key>::sort(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                          gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit, Stage stage) {
  if (first_bit > end_bit || end_bit > key_bits) {
    throw std::invalid_argument(
        fmt::format("radix_sort: bits {} to {} are no range of keys of {} bits", first_bit, end_bit, key_bits));
  }
  require("keys", keys.size(), n, n);
  require("temporary", temporary.size(), temporary_words(n), n);
  if (n <= 1) {
    if (n == 1 && payload_ == Payload::index) values.write(std::vector<uint32_t>{0}, 0, stage);
    return;
  }
  const uint32_t chunk = chunk_of(n);
  const size_t items = tuning_.items;
  const gpu::Range chunks{items * ceil_divide(n, chunk), items};
  const gpu::Range moves{items * ceil_divide(n, tuning_.moves_tiles ? tuning_.tile : chunk), items};
  const uint32_t bits = end_bit - first_bit;
  const uint32_t passes = ceil_divide(bits, tuning_.digit_bits);
  for (uint32_t pass = 0, shift = first_bit; pass < passes; ++pass) {
    const uint32_t width = bits / passes + (pass < bits % passes);
    const uint32_t mask = (1u << width) - 1;
    count_(chunks, stage,
           calls::radix_sort::count{.keys = keys,
                                    .temporary = temporary,
                                    .n = n,
                                    .chunk = chunk,
                                    .pass = pass,
                                    .shift = shift,
                                    .digit_mask = mask});
    offsets_({size_t{tuning_.offset_groups} * tuning_.offset_items, tuning_.offset_items}, stage,
             calls::radix_sort::offsets{.temporary = temporary, .n = n, .chunk = chunk, .pass = pass});
    move_(moves, stage,
          calls::radix_sort::move{.keys = keys,
                                  .values = values,
                                  .temporary = temporary,
                                  .n = n,
                                  .chunk = chunk,
                                  .pass = pass,
                                  .shift = shift,
                                  .digit_mask = mask});
    shift += width;
  }
  settle_(chunks, stage,
          calls::radix_sort::settle{
              .keys = keys, .values = values, .temporary = temporary, .n = n, .chunk = chunk, .passes = passes});
}

template class RadixSort<uint32_t>;
template class RadixSort<uint64_t>;

}  // namespace wavetracer
