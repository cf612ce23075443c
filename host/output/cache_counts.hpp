// SPDX-License-Identifier: Apache-2.0
// The counts of a CacheSummary that add up over frames, with the names they have in summary.json and in manifests.
// Values that describe the table (entries, used, bytes, entries_by_hits) are not added: those of the last frame are
// kept.
#pragma once
#include <array>
#include <utility>
#include "wavetracer/simulation.hpp"

namespace wavetracer {

inline constexpr std::array<std::pair<const char*, uint64_t CacheSummary::*>, 14> cache_counts{{
    {"lookups", &CacheSummary::lookups},
    {"hits", &CacheSummary::hits},
    {"traced", &CacheSummary::traced},
    {"groups", &CacheSummary::groups},
    {"shared", &CacheSummary::shared},
    {"conflicts", &CacheSummary::conflicts},
    {"stale", &CacheSummary::stale},
    {"stored", &CacheSummary::stored},
    {"replaced", &CacheSummary::replaced},
    {"duplicates", &CacheSummary::duplicates},
    {"dropped", &CacheSummary::dropped},
    {"exhausted", &CacheSummary::exhausted},
    {"evicted", &CacheSummary::evicted},
    {"linked", &CacheSummary::linked},
}};

}  // namespace wavetracer
