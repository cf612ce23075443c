// SPDX-License-Identifier: Apache-2.0
// Keys repeat, so that a sort that is not stable is found.
#include "simulation/check_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/digits.hpp"
#include "passes/scan.hpp"
#include "passes/sort.hpp"
#include "simulation/check_numbers.hpp"

namespace wavetracer {
namespace {

std::vector<uint32_t> check_keys(uint32_t count, uint32_t below) {
  CheckNumbers numbers(count);
  std::vector<uint32_t> out(count);
  for (uint32_t& key : out) key = numbers.below(below);
  return out;
}

// Counts the wrong places of the permutation that sorts these keys.
size_t wrong_places(gpu::Context& context, Sort& sort, const std::vector<uint32_t>& keys) {
  const auto count = static_cast<uint32_t>(keys.size());
  auto device_keys = context.buffer(keys, "keys of a check");
  auto order = context.buffer<uint32_t>(count, "order of a check");
  sort(device_keys, order, count, 32);
  std::vector<uint32_t> expected(count);
  std::iota(expected.begin(), expected.end(), 0u);
  std::ranges::stable_sort(expected, {}, [&](uint32_t i) { return keys[i]; });
  const std::vector<uint32_t> sorted = device_keys.read(), found = order.read();
  size_t wrong = 0;
  for (uint32_t i = 0; i < count; ++i) wrong += found[i] != expected[i] || sorted[i] != keys[expected[i]];
  return wrong;
}

}  // namespace

CheckResult check_sorts(gpu::Context& context) {
  constexpr uint32_t few = 1000, many = 40000;  // bitonic blocks have at most 8192
  Sort sort(context);
  size_t wrong = 0;
  for (const uint32_t count : {few, many}) wrong += wrong_places(context, sort, check_keys(count, 1u << 14));
  if (wrong == 0) return {"sorts", true, fmt::format("{} and {} keys are in order", grouped(few), grouped(many))};
  return {"sorts", false, fmt::format("{} of {} keys are in a wrong place", grouped(wrong), grouped(few + many))};
}

CheckResult check_sums(gpu::Context& context) {
  constexpr uint32_t count = 20000;
  std::vector<uint32_t> expected = check_keys(count, 257);
  auto counts = context.buffer(expected, "counts of a check");
  const uint32_t total = std::accumulate(expected.begin(), expected.end(), 0u), found = Scan(context)(counts, count);
  std::exclusive_scan(expected.begin(), expected.end(), expected.begin(), 0u);
  const std::vector<uint32_t> sums = counts.read();
  size_t wrong = found != total;
  for (uint32_t i = 0; i < count; ++i) wrong += sums[i] != expected[i];
  if (wrong == 0) return {"sums", true, fmt::format("{} sums are right", grouped(count))};
  return {"sums", false, fmt::format("{} of {} sums are wrong", grouped(wrong), grouped(count))};
}

}  // namespace wavetracer
