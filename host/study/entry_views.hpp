// SPDX-License-Identifier: Apache-2.0
// Settings whose tables keep their entries, and figure 6.4 of the thesis.
#pragma once
#include <string>
#include <vector>
#include "study/cache_views.hpp"
#include "study/compared_caches.hpp"

namespace wavetracer::study {

// Returns a setting whose cache counts and keeps its entries, for whole frames: "chained mixed counted". It is separate
// from those that are timed, as counting costs time.
Setting counted(Setting setting);
std::string counted_name(const std::string& setting);

// Shows hits of entries along the table, for the counted twins of these settings.
CacheView hits_along_table(std::vector<std::string> settings);

// Returns the entries of the counted twin of a row's setting in one region, from 0; null if there are none.
const EntryGroup* entries_of_region(const std::vector<CacheRow>& rows, const CacheRow& row, uint32_t region);

}  // namespace wavetracer::study
