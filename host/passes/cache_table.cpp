// SPDX-License-Identifier: Apache-2.0
// Sizes, limits and layout of the ray cache's tables.
// Regions are equal shares of cache.buffer_size; the remainder is not allocated.
#include "passes/cache_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "wavetracer/error.hpp"

namespace wavetracer {

using namespace device;

namespace {

constexpr uint64_t least_share = 16;
constexpr uint64_t most_entries = uint64_t{1} << 31;  // slots are 32-bit words, and WT_NONE is not a slot

uint32_t buckets_of(const CacheConfig& config, uint32_t entries) {
  if (config.in_slots()) return entries;
  const double load = config.in_buckets() ? WT_CACHE_BUCKET : config.load_factor;
  return static_cast<uint32_t>(std::max(1.0, std::floor(entries / load)));
}

double head_words_an_entry(const CacheConfig& config) {
  if (config.pooled()) return 2 + 1 / config.load_factor;
  return config.as_printed() ? 3 : config.in_slots() ? 2 : 1;
}

// The first value of heads: WT_NONE in links and roots, which says that there is none; 0 in locks, counts and tags.
uint32_t empty_head(const CacheConfig& config) { return config.linked() ? WT_NONE : 0; }

double bytes_an_entry(const CacheConfig& config) {
  return sizeof(wt_cache_entry) + 4 * (head_words_an_entry(config) + 1) +
         (config.statistics ? 4 + sizeof(wt_cache_cycles) : 0);
}

uint32_t share_of(const CacheConfig& config, uint32_t transmitter_count, const gpu::DeviceInfo& device) {
  check_cache_share(config, transmitter_count);
  if (config.buffer_size > most_entries)
    throw ConfigError(fmt::format("cache.buffer_size = {} is too large: a table has {} entries at most",
                                  config.buffer_size, most_entries));
  const double bytes = static_cast<double>(config.buffer_size) * bytes_an_entry(config);
  const uint64_t fitting =
      std::min(device.max_buffer / sizeof(wt_cache_entry),
               static_cast<uint64_t>(static_cast<double>(device.global_memory) / bytes_an_entry(config)));
  if (config.buffer_size > fitting)
    throw ConfigError(fmt::format(
        "cache.buffer_size = {} is too large for {}: it needs {:.0f} bytes, {} of them in one buffer, and the device "
        "has {} and allows {} a buffer; give {} or less",
        config.buffer_size, device.name, bytes, config.buffer_size * sizeof(wt_cache_entry), device.global_memory,
        device.max_buffer, fitting));
  const auto share = static_cast<uint32_t>(config.buffer_size / transmitter_count);
  return config.in_buckets() ? share / WT_CACHE_BUCKET * WT_CACHE_BUCKET : share;
}

// The number of bits that the numbers 0 .. count - 1 need.
uint32_t bits_of(uint32_t count) {
  return std::max(1u, static_cast<uint32_t>(std::bit_width(std::max(count, 1u) - 1)));
}

uint32_t division_of(const CacheConfig& config) { return config.exact() ? WT_CACHE_MAX_DIVISION : config.division; }

template <class T>
void fill(gpu::Context& context, gpu::Buffer<T>& buffer, uint32_t value, uint64_t first, uint64_t count) {
  context.fill(buffer, &value, sizeof value, first * sizeof(T), count * sizeof(T), Stage::cache_purge);
}

}  // namespace

void check_cache_share(const CacheConfig& config, uint32_t transmitter_count) {
  const uint64_t least = least_share * transmitter_count;
  if (config.buffer_size < least)
    throw ConfigError(fmt::format(
        "cache.buffer_size = {} is too small: {} transmitters share it evenly, and each needs {} entries; give {} or "
        "more",
        config.buffer_size, transmitter_count, least_share, least));
}

CacheTable make_cache_table(gpu::Context& context, const CacheConfig& config, uint32_t transmitter_count,
                            uint32_t surface_count, uint32_t primitive_count) {
  const uint32_t count = std::max(transmitter_count, 1u), share = share_of(config, count, context.info());
  const uint32_t buckets = buckets_of(config, share);
  CacheTable table;
  table.config = config;
  table.widths = {bits_of(division_of(config)), bits_of(surface_count), bits_of(primitive_count)};
  for (uint32_t r = 0; r < count; ++r) table.regions.push_back({r * share, share, r * buckets, buckets, 0, 1});
  const size_t entries = size_t{share} * count;
  const size_t heads = config.pooled() ? 2 * entries + size_t{buckets} * count
                                       : static_cast<size_t>(head_words_an_entry(config)) * entries;
  table.entries = context.buffer<wt_cache_entry>(entries, "cache entries (cache.buffer_size)");
  table.heads = context.buffer<uint32_t>(heads, "cache heads (cache.buffer_size)");
  table.used = context.buffer<uint32_t>(count, "cache regions in use");
  table.device_regions = context.buffer(table.regions, "cache regions");
  table.counters = context.buffer(std::vector<wt_cache_counters>(1), "cache counters");
  table.hits = context.buffer<uint32_t>(config.statistics ? entries : 1, "cache hits");
  table.cycles = context.buffer<wt_cache_cycles>(config.statistics ? entries : 1, "cache cycles");
  table.uses = context.buffer<uint32_t>(entries, "cache uses");
  table.clear(context);
  return table;
}

CacheMovement make_cache_movement(gpu::Context& context) {
  return {context.buffer<float>(4, "receivers"), 0, context.buffer(std::vector<uint32_t>(1), "instances moved")};
}

gpu::Definitions CacheTable::definitions(bool bulk) const {
  gpu::Definitions d{{"WT_CACHE_DIVISION", fmt::format("{}u", division_of(config))},
                     {"WT_CACHE_HASH_METHOD", fmt::format("{}", config.hash_method)}};
  if (config.pooled()) {
    d["WT_CACHE_CHAINED"] = "1";
    d["WT_CACHE_BUCKETS_TOTAL"] = fmt::format("{}u", regions.size() * regions.front().buckets);
  } else if (config.linked()) {
    d["WT_CACHE_THESIS"] = d["WT_CACHE_THESIS_CHAINED"] = "1";
  } else if (config.in_slots()) {
    d[config.as_printed() ? "WT_CACHE_THESIS" : "WT_CACHE_OPEN"] = "1";
    if (config.locks()) {
      d["WT_CACHE_MUTEX"] = "1";
    } else {
      d["WT_CACHE_READERS"] = fmt::format("{}u", config.readers_number);
    }
  } else {
    d["WT_CACHE_CONCURRENT"] = "1";
  }
  if (config.exact()) {
    d["WT_CACHE_EXACT"] = "1";
  } else if (config.by_precision()) {
    d["WT_CACHE_PRECISION"] = "1";
    d["WT_CACHE_RESIDUAL"] = fmt::format("{:a}f", static_cast<float>(config.residual_value));
  }
  if (config.own_points()) d["WT_CACHE_OWN_POINT"] = "1";
  if (config.holds_all()) d["WT_CACHE_ALL"] = "1";
  if (config.statistics) d["WT_CACHE_STATISTICS"] = "1";
  if (bulk) d["WT_CACHE_BULK"] = "1";
  return d;
}

uint64_t CacheTable::bytes() const {
  return entries.bytes() + heads.bytes() + used.bytes() + device_regions.bytes() + counters.bytes() + hits.bytes() +
         cycles.bytes() + uses.bytes();
}

void CacheTable::clear(gpu::Context& context, uint32_t region) {
  const wt_cache_region& r = regions.at(region);
  const uint32_t head = empty_head(config);
  fill(context, entries, 0, r.first_entry, r.entries);
  if (config.pooled()) {
    const uint64_t all_buckets = uint64_t{r.buckets} * regions.size();
    fill(context, heads, head, r.first_bucket, r.buckets);
    fill(context, heads, head, all_buckets + 2 * uint64_t{r.first_entry}, 2 * uint64_t{r.entries});
  } else {
    const auto words = static_cast<uint64_t>(head_words_an_entry(config));
    fill(context, heads, head, words * r.first_entry, words * r.entries);
  }
  fill(context, used, 0, region, 1);
  if (config.statistics) {
    fill(context, hits, 0, r.first_entry, r.entries);
    fill(context, cycles, 0, r.first_entry, r.entries);
  }
  fill(context, uses, 0, r.first_entry, r.entries);
}

void CacheTable::clear(gpu::Context& context) {
  fill(context, entries, 0, 0, entries.size());
  fill(context, heads, empty_head(config), 0, heads.size());
  fill(context, used, 0, 0, used.size());
  fill(context, hits, 0, 0, hits.size());
  fill(context, cycles, 0, 0, cycles.size());
  fill(context, uses, 0, 0, uses.size());
}

}  // namespace wavetracer
