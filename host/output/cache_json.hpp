// SPDX-License-Identifier: Apache-2.0
// The results of a ray cache as JSON: the part that summary.json and the lines of a manifest share.
#pragma once
#include <nlohmann/json.hpp>
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// Writes counts by their names, then entries, used, bytes, lookups_per_depth, hits_per_depth, shared_per_depth and
// entries_by_hits.
nlohmann::ordered_json encode_cache(const CacheSummary& cache);
// Reads them back, for a cache that was on. Throws nlohmann::json::exception if a value is missing.
CacheSummary decode_cache(const nlohmann::ordered_json& json);

}  // namespace wavetracer
