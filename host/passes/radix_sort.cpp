// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/primitives/radix_sort.cl (groups) and radix_sort_cpu.cl (chunks). Temporary memory has the
// layout of kernels/lib/radix_tiles.clh and radix.clh.
#include "passes/radix_sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace wavetracer {

namespace {

constexpr uint32_t flag_words = 16;  // WT_MAX_PASSES
constexpr uint32_t line_words = 16;  // keys and values of the temporary memory begin at multiples of this

uint32_t ceil_divide(uint32_t a, uint32_t b) { return a / b + (a % b != 0); }

size_t lines_of(uint32_t n) { return (size_t{n} + line_words - 1) / line_words * line_words; }

void require(const char* what, size_t has, size_t needs, uint32_t n) {
  if (has >= needs) return;
  throw std::invalid_argument(
      fmt::format("radix_sort: {} has {} elements, {} are needed to sort {} keys", what, has, needs, n));
}

// The digits of a range of bits: about as many bits each, the first ones one more. A pass has one.
struct Digits {
  uint32_t first_bit, bits, passes;
  Digits(uint32_t first, uint32_t count, uint32_t widest)
      : first_bit(first), bits(count), passes(ceil_divide(count, widest)) {}
  uint32_t shift(uint32_t pass) const { return first_bit + pass * (bits / passes) + std::min(pass, bits % passes); }
  uint32_t mask(uint32_t pass) const { return (1u << (bits / passes + (pass < bits % passes))) - 1; }
};

template <class Key>
gpu::Definitions common_definitions(Payload payload, uint32_t digit_bits) {
  return {{"WT_KEY", sizeof(Key) == 4 ? "uint" : "ulong"},
          {"WT_PAYLOAD", std::to_string(static_cast<int>(payload))},
          {"WT_DIGIT_BITS", std::to_string(digit_bits)}};
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
  const RadixChunks tuning = radix_chunks(context.info());
  const uint64_t keys = form == SortForm::lines ? 0 : tuning.direct_bytes / (sizeof(Key) + value_bytes);
  gpu::Definitions definitions = common_definitions<Key>(payload, tuning.digit_bits);
  definitions["WT_SCATTER_KEYS"] = std::to_string(keys) + "u";
  constexpr const char* program = "radix_sort_cpu";
  form_ = Chunks{tuning,
                 {context, definitions, program},
                 {context, definitions, program},
                 {context, definitions, program},
                 {context, definitions, program}};
}

template <class Key>
RadixSort<Key>::RadixSort(gpu::Context& context, Payload payload, const RadixTuning& groups) : payload_(payload) {
  gpu::Definitions definitions = common_definitions<Key>(payload, groups.digit_bits);
  definitions["WT_ITEMS"] = std::to_string(groups.items);
  definitions["WT_KEYS_AN_ITEM"] = std::to_string(groups.item_keys);
  definitions["WT_RANKS"] = std::to_string(static_cast<int>(groups.ranks));
  definitions["WT_COLUMNS"] = std::to_string(groups.columns);
  definitions["WT_LATE_VALUES"] = groups.late_values ? "1" : "0";
  definitions["WT_WINDOW"] = std::to_string(groups.window) + "u";
  definitions["WT_LOOKS"] = std::to_string(groups.looks) + "u";
  definitions["WT_TICKETS"] = groups.tickets ? "1" : "0";
  definitions["WT_SILENT"] = std::to_string(groups.silent) + "u";
  definitions["WT_COUNT_ITEMS"] = std::to_string(groups.count_items) + "u";
  if (groups.registers > 0 && on_nvidia(context.info()))
    definitions["-cl-nv-maxrregcount"] = std::to_string(groups.registers);
  form_ = Groups{groups,
                 {context, definitions},
                 {context, definitions},
                 {context, definitions},
                 {context, definitions},
                 {context, definitions}};
}

template <class Key>
size_t RadixSort<Key>::temporary_words(uint32_t n) const {
  const size_t copies = lines_of(n) * (sizeof(Key) / 4 + (payload_ == Payload::none ? 0 : 1));
  if (const auto* groups = std::get_if<Groups>(&form_)) {
    const RadixTuning& tuning = groups->tuning;
    const size_t passes = ceil_divide(key_bits, tuning.digit_bits), tiles = ceil_divide(n, tuning.tile());
    return 2 * flag_words + copies + (2 * (passes + tiles) << tuning.digit_bits);
  }
  const RadixChunks& tuning = std::get<Chunks>(form_).tuning;
  // This is not ceil(n / chunk): that may be more for fewer keys, and a buffer for n keys must suffice for them, too.
  const size_t chunks = std::min(ceil_divide(n, tuning.tile), tuning.most_chunks);
  return flag_words + copies + ((1 + chunks) << tuning.digit_bits);
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                                gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit, Stage stage) {
  if (payload_ != Payload::none) require("values", values.size(), n, n);
  sort({keys, values, n, temporary, first_bit, end_bit, stage});
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                                unsigned first_bit, unsigned end_bit, Stage stage) {
  if (payload_ != Payload::none) throw std::logic_error("radix_sort: a sort with a payload was given no values");
  sort({keys, temporary, n, temporary, first_bit, end_bit, stage});
}

template <class Key>
void RadixSort<Key>::sort(const Call& c) {
  if (c.first_bit > c.end_bit || c.end_bit > key_bits) {
    throw std::invalid_argument(
        fmt::format("radix_sort: bits {} to {} are no range of keys of {} bits", c.first_bit, c.end_bit, key_bits));
  }
  require("keys", c.keys.size(), c.n, c.n);
  require("temporary", c.temporary.size(), temporary_words(c.n), c.n);
  if (c.n > 1)
    std::visit([&](auto& form) { sort_by(form, c); }, form_);
  else if (c.n == 1 && payload_ == Payload::index)
    c.values.write(std::vector<uint32_t>{0}, 0, c.stage);
}

template <class Key>
void RadixSort<Key>::sort_by(Chunks& by, const Call& c) {
  const uint32_t tiles = ceil_divide(c.n, by.tuning.tile);
  const uint32_t chunk = by.tuning.tile * std::max(1u, ceil_divide(tiles, by.tuning.most_chunks));
  const gpu::Range chunks{ceil_divide(c.n, chunk), 1};
  const Digits digits(c.first_bit, c.end_bit - c.first_bit, by.tuning.digit_bits);
  for (uint32_t pass = 0; pass < digits.passes; ++pass) {
    const uint32_t shift = digits.shift(pass), mask = digits.mask(pass);
    by.count(chunks, c.stage,
             {.keys = c.keys,
              .temporary = c.temporary,
              .n = c.n,
              .chunk = chunk,
              .pass = pass,
              .shift = shift,
              .digit_mask = mask});
    by.offsets({1, 1}, c.stage, {.temporary = c.temporary, .n = c.n, .chunk = chunk, .pass = pass});
    by.move(chunks, c.stage,
            {.keys = c.keys,
             .values = c.values,
             .temporary = c.temporary,
             .n = c.n,
             .chunk = chunk,
             .pass = pass,
             .shift = shift,
             .digit_mask = mask});
  }
  by.settle(chunks, c.stage,
            {.keys = c.keys,
             .values = c.values,
             .temporary = c.temporary,
             .n = c.n,
             .chunk = chunk,
             .passes = digits.passes});
}

// A count in the words of tiles has 30 bits, so more keys take several launches per pass: each goes on where the last
// one ended.
template <class Key>
void RadixSort<Key>::sort_by(Groups& by, const Call& c) {
  const RadixTuning& tuning = by.tuning;
  const Digits digits(c.first_bit, c.end_bit - c.first_bit, tuning.digit_bits);
  const uint32_t tiles = ceil_divide(c.n, tuning.tile()), most_tiles = std::max(1u, tuning.most_keys / tuning.tile());
  const size_t items = tuning.count_items, enough = std::min<size_t>(ceil_divide(c.n, 2048), 1024);
  const uint32_t counted = 8 * tuning.count_items;  // keys that a group counts at once
  const uint32_t chunk = counted * ceil_divide(ceil_divide(c.n, counted), tuning.count_groups);
  by.clear({256 * enough, 256}, c.stage, {.temporary = c.temporary, .n = c.n});
  if (digits.passes > 0) {
    by.histogram({items * ceil_divide(c.n, chunk), items}, c.stage,
                 {.keys = c.keys,
                  .temporary = c.temporary,
                  .n = c.n,
                  .chunk = chunk,
                  .first_bit = digits.first_bit,
                  .bits = digits.bits,
                  .passes = digits.passes});
    by.starts({items * digits.passes, items}, c.stage, {.temporary = c.temporary, .n = c.n});
  }
  for (uint32_t pass = 0; pass < digits.passes; ++pass)
    for (uint32_t first = 0, turn = 0; first < tiles; first += most_tiles, turn = 1 - turn)
      by.move({size_t{tuning.items} * std::min(most_tiles, tiles - first), tuning.items}, c.stage,
              {.keys = c.keys,
               .values = c.values,
               .temporary = c.temporary,
               .n = c.n,
               .pass = pass,
               .shift = digits.shift(pass),
               .digit_mask = digits.mask(pass),
               .first_tile = first,
               .turn = turn});
  by.settle({256 * enough, 256}, c.stage,
            {.keys = c.keys, .values = c.values, .temporary = c.temporary, .n = c.n, .passes = digits.passes});
}

template class RadixSort<uint32_t>;
template class RadixSort<uint64_t>;

}  // namespace wavetracer
