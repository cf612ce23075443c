// SPDX-License-Identifier: Apache-2.0
// An odd number of radix passes is measured, so that settle has something to move.
#include "sort_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <vector>

#include "device_sort.hpp"
#include "passes/bitonic_sort.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t most_of_other_form = 1u << 22, most_of_bitonic = 1u << 20;
constexpr double comparator_operations = 3;  // a comparison and two selections

bool wanted(const KernelRows& rows, std::string_view program) {
  return std::ranges::any_of(sort_kernels(), [&](const std::string& kernel) {
    return kernel.starts_with(program) && kernel[program.size()] == '/' && rows.wants(kernel);
  });
}

uint32_t parts(uint32_t whole, uint32_t part) { return (whole + part - 1) / part; }

// bits: those that differ, three or five digits of eight. The work of keys is that of the passes together.
template <class Key>
void measure_radix(KernelRows& rows, gpu::Context& context, SortForm form, uint32_t n, unsigned bits) {
  const bool groups = form == SortForm::groups;
  if (!wanted(rows, groups ? "radix_sort" : "radix_sort_cpu")) return;
  const double passes = bits / 8, pair_bytes = sizeof(Key) + sizeof(uint32_t), keys_once = n;
  std::map<std::string, KernelShare> kernels;
  if (groups) {
    const RadixTuning tuning = radix_groups(context.info(), sizeof(Key), 4);
    const double digits = 1u << tuning.digit_bits, state = digits * parts(n, tuning.tile());
    const double words_a_key = digits / tuning.tile();
    kernels = {{"radix_sort/clear", {"words", state, {.bytes = 4}}},
               {"radix_sort/histogram", {"keys", keys_once, {.bytes = sizeof(Key), .operations = 3 * passes}}},
               {"radix_sort/starts", {"digits", passes * digits, {.bytes = 8, .operations = 1}}},
               // A tile clears a word for each digit, writes it twice and reads one at least.
               {"radix_sort/move", {"keys", passes * n, {.bytes = 2 * pair_bytes + 16 * words_a_key, .operations = 6}}},
               {"radix_sort/settle", {"keys", keys_once, {.bytes = 2 * pair_bytes}}}};
  } else {
    const RadixChunks tuning = radix_chunks(context.info());
    const uint32_t chunk = tuning.tile * std::max(1u, parts(parts(n, tuning.tile), tuning.most_chunks));
    const double digits = 1u << tuning.digit_bits, counts = digits * parts(n, chunk);
    kernels = {{"radix_sort_cpu/count", {"keys", passes * n, {.bytes = sizeof(Key), .operations = 3}}},
               {"radix_sort_cpu/offsets", {"counts", passes * counts, {.bytes = 8, .operations = 1}}},
               {"radix_sort_cpu/move", {"keys", passes * n, {.bytes = 2 * pair_bytes, .operations = 6}}},
               {"radix_sort_cpu/settle", {"keys", keys_once, {.bytes = 2 * pair_bytes}}}};
  }
  DeviceKeys<Key> keys(context, keys_of_bits<Key>(n, bits), bits);
  const auto sort = keys.radix(Payload::words, form);
  rows.measure(context,
               {.variant = fmt::format("u{} of {} bits + u32, n = 2^{}", 8 * sizeof(Key), bits, std::bit_width(n) - 1),
                .kernels = kernels,
                .run = sort.launch,
                .wrong = [&] { return keys.wrong(sort); },
                .prepare = [&] { keys.restore(); }});
}

void measure_bitonic(KernelRows& rows, gpu::Context& context, uint32_t n) {
  if (!wanted(rows, "bitonic_sort")) return;
  const uint32_t block = BitonicSort<uint32_t>(context, Payload::words).block();
  DeviceKeys<uint32_t> keys(context, keys_of_bits<uint32_t>(n, 32), 32);
  const auto sort = keys.bitonic(Payload::words);
  const double steps_in_block = std::bit_width(block) - 1, merges = std::bit_width(n / block) - 1;
  const KernelWork first{.bytes = 20, .operations = comparator_operations * steps_in_block * (steps_in_block + 1) / 4};
  rows.measure(
      context,
      {.variant = fmt::format("u32 + u32, n = 2^{}", std::bit_width(n) - 1),
       .kernels = {{"bitonic_sort/sort_blocks", {"keys", double{1} * n, first}},
                   // A step reads all keys with their indices, and writes those that it exchanges.
                   {"bitonic_sort/one_step",
                    {"keys", merges * (merges + 1) / 2 * n, {.bytes = 8, .operations = comparator_operations / 2}}},
                   {"bitonic_sort/merge_blocks",
                    {"keys", merges * n, {.bytes = 16, .operations = comparator_operations * steps_in_block / 2}}},
                   {"bitonic_sort/gather", {"keys", double{1} * n, {.bytes = 12, .gathers = 1}}}},
       .run = sort.launch,
       .wrong = [&] { return keys.wrong(sort); },
       .prepare = [&] { keys.restore(); }});
}

}  // namespace

std::span<const std::string> sort_kernels() {
  static const std::vector<std::string> names{
      "radix_sort/clear",      "radix_sort/histogram",     "radix_sort/starts",      "radix_sort/move",
      "radix_sort/settle",     "radix_sort_cpu/count",     "radix_sort_cpu/offsets", "radix_sort_cpu/move",
      "radix_sort_cpu/settle", "bitonic_sort/sort_blocks", "bitonic_sort/one_step",  "bitonic_sort/merge_blocks",
      "bitonic_sort/gather"};
  return names;
}

void measure_sort_kernels(KernelRows& rows, gpu::Context& context, uint32_t n) {
  const bool cpu = context.info().cpu;
  const auto own = cpu ? SortForm::chunks : SortForm::groups, other = cpu ? SortForm::groups : SortForm::chunks;
  measure_radix<uint32_t>(rows, context, own, n, 24);
  measure_radix<uint64_t>(rows, context, own, n, 40);
  measure_radix<uint32_t>(rows, context, other, std::min(n, most_of_other_form), 24);
  measure_bitonic(rows, context, std::min(n, most_of_bitonic));
}

}  // namespace wavetracer::bench
