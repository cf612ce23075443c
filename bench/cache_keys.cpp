// SPDX-License-Identifier: Apache-2.0
// Counts keys per bucket, and follows the concurrent table's search for a place, one key after the other.
#include "cache_keys.hpp"

#include <algorithm>
#include <tuple>

namespace wavetracer::bench {
namespace {

std::vector<uint32_t> buckets_of(std::span<const RayKey> keys, uint32_t hash_method, device::wt_cache_widths widths,
                                 uint32_t buckets) {
  std::vector<uint32_t> all;
  for (const RayKey& key : keys)
    all.push_back(
        device::wt_cache_bucket(device::wt_cache_hash(hash_method, key.cells, key.left, key.surface, widths), buckets));
  return all;
}

double overflow(const std::vector<uint32_t>& homes, uint32_t buckets) {
  std::vector<uint32_t> filled(buckets);
  size_t lost = 0;
  for (const uint32_t home : homes) {
    uint32_t probe = 0;
    while (probe < WT_CACHE_PROBES && filled[(home + probe) % buckets] == WT_CACHE_BUCKET) ++probe;
    if (probe == WT_CACHE_PROBES)
      ++lost;
    else
      ++filled[(home + probe) % buckets];
  }
  return static_cast<double>(lost) / static_cast<double>(homes.size());
}

}  // namespace

std::vector<RayKey> distinct_keys(const SceneRays& rays, uint32_t division) {
  std::vector<RayKey> keys;
  for (const Segment& segment : rays.segments)
    for (size_t i = 0; i < segment.rays.size(); ++i) {
      const auto& d = segment.rays[i].direction;
      keys.push_back({device::wt_cache_cells(d[0], d[1], d[2], division), segment.left[i], segment.surface[i]});
    }
  const auto value = [](const RayKey& key) { return std::tie(key.left, key.cells); };
  std::sort(keys.begin(), keys.end(), [&](const RayKey& a, const RayKey& b) { return value(a) < value(b); });
  keys.erase(
      std::unique(keys.begin(), keys.end(), [&](const RayKey& a, const RayKey& b) { return value(a) == value(b); }),
      keys.end());
  return keys;
}

Spread spread(std::span<const RayKey> keys, uint32_t hash_method, device::wt_cache_widths widths) {
  const auto buckets = static_cast<uint32_t>(std::max<size_t>(2, keys.size() / 3));
  std::vector<uint32_t> counts(buckets);
  for (const uint32_t bucket : buckets_of(keys, hash_method, widths, buckets)) ++counts[bucket];
  const double expected = static_cast<double>(keys.size()) / buckets;
  double chi_square = 0;
  for (const uint32_t count : counts) chi_square += (count - expected) * (count - expected) / expected;

  const auto wide = static_cast<uint32_t>(
      std::max(1.0, static_cast<double>(keys.size()) / (0.8 * static_cast<double>(WT_CACHE_BUCKET))));
  const auto empty = static_cast<double>(std::count(counts.begin(), counts.end(), 0u));
  return {1 - empty / buckets, *std::max_element(counts.begin(), counts.end()), chi_square / (buckets - 1),
          overflow(buckets_of(keys, hash_method, widths, wide), wide)};
}

}  // namespace wavetracer::bench
