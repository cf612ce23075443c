// SPDX-License-Identifier: Apache-2.0
// The regions of a cache's table, one for each transmitter: the patchwork of figures 6.6 and 6.7 of the thesis.
#pragma once
#include <string>
#include <vector>
#include "study/cache_claims.hpp"
#include "study/cache_views.hpp"

namespace wavetracer::study {

// Shows nanoseconds per segment to write, to read, to gather (and to trace) of these settings, region by region.
CacheView regions(std::vector<std::string> settings, bool with_trace = false);

double region_lookups(const CacheRow& row);  // a measure of how busy it is
double access_ns(const CacheRow& row);       // a write and a read

// Judges for each of these settings whether two values of the regions correlate: "confirmed for "A" (0.91), not for "B"
// (-0.20)". The limit is a correlation of at least a half, or at most minus a half if they are claimed to be opposite;
// "not measured" if there are fewer than three regions.
Judge<CacheRow> across_regions(std::vector<std::string> settings, CacheValue value, CacheValue with, bool opposite);
// Judges in the same way the entries of each region, whose hits measure how busy it is, in one frame of all
// transmitters.
Judge<CacheRow> across_entries(std::vector<std::string> settings, double EntryGroup::*cycles);

}  // namespace wavetracer::study
