// SPDX-License-Identifier: Apache-2.0
// Each setting is a list of keys, with the words of the field table (host/config).
#include "study/compared_caches.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <utility>

namespace wavetracer::study {
namespace {

using Change = std::function<void(CacheConfig&)>;

// Makes the open table of the thesis, then applies `change`. The user's config decides `statistics` and `first_depth`.
Setting thesis_table(const std::string& name, uint32_t hash_method, const Change& change) {
  return {name + " " + hash_name(hash_method), [=](Config& config) {
            CacheConfig& cache = config.cache;
            cache.kind = "open";
            cache.key = "quantised";
            cache.hash_method = hash_method;
            cache.division = thesis_division;
            cache.buffer_size = thesis_open_buffer;
            cache.load_factor = thesis_load_factor;
            cache.locking = "readers";
            cache.readers_number = thesis_readers;
            cache.purge = "position";
            cache.position_step_m = thesis_position_step_m;
            cache.residual_value = thesis_residual;
            cache.scope = "all";
            cache.hit_point = "cached";
            change(cache);
          }};
}

Setting ours_with(const std::string& name, const Change& change) {
  return {name, [=](Config& config) {
            CacheConfig& cache = config.cache;
            cache.kind = "concurrent";
            cache.key = "quantised";
            cache.division = thesis_division;
            cache.buffer_size = ample_buffer(config);
            cache.purge = "position";
            cache.position_step_m = thesis_position_step_m;
            cache.scope = "static";
            cache.hit_point = "own";
            change(cache);
          }};
}

void nothing_else(CacheConfig&) {}

}  // namespace

uint64_t ample_buffer(const Config& config) { return std::max<uint64_t>(uint64_t{1} << 20, 8 * *config.trace.rays); }

void uncached(Config& config) {
  config.trace.directions = "random";
  config.trace.reuse = false;
  config.order = {};
  config.cache.kind = "none";
}

Setting no_cache() {
  return {"no cache", [](Config&) {}};
}

Setting chained(uint32_t hash_method, uint64_t buffer_size) {
  Setting setting = thesis_table("chained", hash_method, [=](CacheConfig& cache) {
    cache.kind = "chained";
    cache.buffer_size = buffer_size;
  });
  if (buffer_size != thesis_chained_buffer) setting.name += fmt::format(" {} entries", buffer_size);
  return setting;
}

Setting open_mutex(uint32_t hash_method) {
  return thesis_table("mutex", hash_method, [](CacheConfig& cache) { cache.locking = "mutex"; });
}

Setting open_readers(uint32_t hash_method) { return thesis_table("readers", hash_method, nothing_else); }
Setting position(uint32_t hash_method) { return thesis_table("position", hash_method, nothing_else); }

Setting precision(double residual, uint32_t hash_method) {
  return thesis_table(fmt::format("precision {:g}", residual), hash_method, [=](CacheConfig& cache) {
    cache.division = thesis_precision_division;
    cache.purge = "precision";
    cache.residual_value = residual;
  });
}

Setting as_printed(Setting setting) {
  return {"printed " + setting.name, [apply = std::move(setting.apply)](Config& config) {
            apply(config);
            config.cache.kind = config.cache.pooled() ? CacheKind("thesis-chained") : CacheKind("thesis");
          }};
}

Setting ours() { return ours_with("concurrent", nothing_else); }
Setting exact() {
  return ours_with("concurrent exact", [](CacheConfig& cache) { cache.key = "exact"; });
}

Setting reuse_instead() {
  return {"no cache with reuse", [](Config& config) { config.trace.reuse = true; }};
}

Setting born_in_order() {
  return {"no cache along hilbert", [](Config& config) { config.trace.directions = "hilbert"; }};
}

Setting with_order(Setting setting) {
  return {setting.name, [apply = std::move(setting.apply)](Config& config) {
            apply(config);
            config.order.method = "hilbert3d-histogram";
          }};
}

const std::vector<std::string>& cache_keys() {
  static const std::vector<std::string> keys = {
      "trace.reuse",           "cache.kind",           "cache.key",     "cache.hash_method",    "cache.division",
      "cache.buffer_size",     "cache.load_factor",    "cache.locking", "cache.readers_number", "cache.purge",
      "cache.position_step_m", "cache.residual_value", "cache.scope",   "cache.hit_point",      "cache.innerframe"};
  return keys;
}

std::string hash_name(uint32_t hash_method) {
  return hash_method == 1 ? "uniform" : hash_method == 2 ? "Morton" : "mixed";
}

}  // namespace wavetracer::study
