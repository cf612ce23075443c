// SPDX-License-Identifier: Apache-2.0
// The regions of a cache's table, one for each transmitter: the patchwork of figures 6.6 and 6.7 of the thesis.
#pragma once
#include <string>
#include <vector>
#include "study/cache_claims.hpp"
#include "study/cache_rows.hpp"

namespace wavetracer::study {

// Returns the rows of a setting's regions, at the first number of rays in the first world.
std::vector<const CacheRow*> regions_of(const CacheRows& rows, const std::string& setting);

double region_lookups(const CacheRow& row);  // a measure of how busy it is
double access_ns(const CacheRow& row);       // a write and a read

// A number of a region.
using RegionValue = double (*)(const CacheRow&);

// Answers for each of these settings whether two values of the regions correlate: by at least a half, or by at most
// minus a half if they are claimed to be opposite. The noise is that of a coefficient of so few pairs (R. A. Fisher,
// Metron 1921); with three regions or fewer nothing is decided.
Judge<CacheRow> across_regions(std::vector<std::string> settings, RegionValue value, RegionValue with, bool opposite);
// A number of the entries of a region.
using EntryValue = double (*)(const EntryGroup&);
double entry_hits(const EntryGroup& region);  // a measure of how busy it is
double entry_reads(const EntryGroup& region);
double entry_writes(const EntryGroup& region);

// Answers in the same way for two values of the entries of each region, in one frame of all transmitters.
Judge<CacheRow> across_entries(std::vector<std::string> settings, EntryValue value, EntryValue with);

// Answers whether a coefficient of `pairs` pairs is at least a half.
Answer correlates(double coefficient, size_t pairs);

}  // namespace wavetracer::study
