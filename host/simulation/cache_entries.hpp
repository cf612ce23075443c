// Entries of a ray cache's table, read back with where a search meets each.
#pragma once
#include "passes/cache_table.hpp"
#include "wavetracer/cache_entries.hpp"

namespace wavetracer {

// Appends the rows of `frame` (as results count frames). now: of the cache's own count of frames, which entries were
// stamped with. Reads the whole table from the device. Needs cache.statistics.
void add_cache_entries(const CacheTable& table, uint32_t frame, uint32_t now, CacheEntryRows& rows);

}  // namespace wavetracer
