// SPDX-License-Identifier: Apache-2.0
// Entries of a ray cache's table, read back with the depth at which a search meets each.
#pragma once
#include "passes/cache_table.hpp"
#include "wavetracer/cache_entries.hpp"

namespace wavetracer {

// Appends the rows of `frame` (as results count frames). now: the cache's own number of the frame, with which entries
// were stamped. Reads the whole table from the device. Needs cache.statistics.
void add_cache_entries(const CacheTable& table, uint32_t frame, uint32_t now, CacheEntryRows& rows);

}  // namespace wavetracer
