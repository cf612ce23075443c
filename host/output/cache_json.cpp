// SPDX-License-Identifier: Apache-2.0
// Converts in both directions with the same list of counts.
// The cache must be on: otherwise there is nothing to write.
#include "output/cache_json.hpp"
#include "base/json_whole.hpp"
#include "output/cache_counts.hpp"

namespace wavetracer {

nlohmann::ordered_json encode_cache(const CacheSummary& cache) {
  nlohmann::ordered_json json;
  for (const auto& [name, count] : cache_counts) json[name] = cache.*count;
  json["entries"] = cache.entries;
  json["used"] = cache.used;
  json["bytes"] = cache.bytes;
  json["lookups_per_depth"] = cache.lookups_per_depth;
  json["hits_per_depth"] = cache.hits_per_depth;
  json["shared_per_depth"] = cache.shared_per_depth;
  json["entries_by_hits"] = cache.entries_by_hits;
  return json;
}

CacheSummary decode_cache(const nlohmann::ordered_json& json) {
  CacheSummary cache;
  cache.on = true;
  for (const auto& [name, count] : cache_counts) cache.*count = whole_at<uint64_t>(json, name);
  cache.entries = whole_at<uint64_t>(json, "entries");
  cache.used = whole_at<uint64_t>(json, "used");
  cache.bytes = whole_at<uint64_t>(json, "bytes");
  cache.lookups_per_depth = whole_list<uint64_t>(json, "lookups_per_depth");
  cache.hits_per_depth = whole_list<uint64_t>(json, "hits_per_depth");
  cache.shared_per_depth = whole_list<uint64_t>(json, "shared_per_depth");
  cache.entries_by_hits = whole_list<uint64_t>(json, "entries_by_hits");
  return cache;
}

}  // namespace wavetracer
