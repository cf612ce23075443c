// Both ways over the one list of counts.
// Assumes a cache that is on: of one that is off there is nothing to say.
#include "output/cache_json.hpp"
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
  for (const auto& [name, count] : cache_counts) cache.*count = json.at(name);
  cache.entries = json.at("entries");
  cache.used = json.at("used");
  cache.bytes = json.at("bytes");
  cache.lookups_per_depth = json.at("lookups_per_depth").get<std::vector<uint64_t>>();
  cache.hits_per_depth = json.at("hits_per_depth").get<std::vector<uint64_t>>();
  cache.shared_per_depth = json.at("shared_per_depth").get<std::vector<uint64_t>>();
  cache.entries_by_hits = json.at("entries_by_hits").get<std::vector<uint64_t>>();
  return cache;
}

}  // namespace wavetracer
