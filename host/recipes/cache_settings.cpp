// Each setting is a list of keys.
// Assumes the field table's words for them (host/config).
#include "recipes/cache_settings.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <utility>

namespace wavetracer::recipes {
namespace {

// Entries for all segments of a frame, of which a ray has few.
uint64_t ample_buffer(uint64_t rays) { return std::max<uint64_t>(uint64_t{1} << 20, 8 * rays); }

CacheConfig thesis_cache(CacheKind kind, uint32_t hash_method, uint64_t buffer_size) {
  CacheConfig cache;
  cache.kind = kind;
  cache.key = "quantised";
  cache.hash_method = hash_method;
  cache.division = thesis_division;
  cache.buffer_size = buffer_size;
  cache.load_factor = thesis_load_factor;
  cache.locking = "readers";
  cache.readers_number = thesis_readers;
  cache.purge = "position";
  cache.position_step_m = thesis_position_step_m;
  cache.scope = "all";
  cache.hit_point = "cached";
  return cache;
}

// `statistics` and `first_depth` are left to the user's config.
Setting cached(const std::string& name, CacheConfig cache) {
  return {name, [cache](Config& config) {
            const bool statistics = config.cache.statistics;
            const uint32_t first_depth = config.cache.first_depth;
            config.cache = cache;
            config.cache.statistics = statistics;
            config.cache.first_depth = first_depth;
          }};
}

Setting ours_with(const std::string& name, CacheKey key) {
  return {name, [key](Config& config) {
            config.cache.kind = "concurrent";
            config.cache.key = key;
            config.cache.division = thesis_division;
            config.cache.buffer_size = ample_buffer(*config.trace.rays);
            config.cache.purge = "position";
            config.cache.position_step_m = thesis_position_step_m;
            config.cache.scope = "static";
            config.cache.hit_point = "own";
          }};
}

}  // namespace

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
  std::string name = "chained " + hash_name(hash_method);
  if (buffer_size != thesis_chained_buffer) name += fmt::format(" {} entries", buffer_size);
  return cached(name, thesis_cache("chained", hash_method, buffer_size));
}

Setting open_mutex(uint32_t hash_method) {
  CacheConfig cache = thesis_cache("open", hash_method, thesis_open_buffer);
  cache.locking = "mutex";
  return cached("mutex " + hash_name(hash_method), cache);
}

Setting open_readers(uint32_t hash_method) {
  return cached("readers " + hash_name(hash_method), thesis_cache("open", hash_method, thesis_open_buffer));
}

Setting position(uint32_t hash_method) {
  return cached("position " + hash_name(hash_method), thesis_cache("open", hash_method, thesis_open_buffer));
}

Setting precision(double residual, uint32_t hash_method) {
  CacheConfig cache = thesis_cache("open", hash_method, thesis_open_buffer);
  cache.division = thesis_precision_division;
  cache.purge = "precision";
  cache.residual_value = residual;
  return cached(fmt::format("precision {:g} {}", residual, hash_name(hash_method)), cache);
}

Setting ours() { return ours_with("concurrent", "quantised"); }
Setting exact() { return ours_with("concurrent exact", "exact"); }

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
      "cache.position_step_m", "cache.residual_value", "cache.scope",   "cache.hit_point"};
  return keys;
}

std::string hash_name(uint32_t hash_method) {
  return hash_method == 1 ? "uniform" : hash_method == 2 ? "Morton" : "mixed";
}

}  // namespace wavetracer::recipes
