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

// A number of a region.
using RegionValue = double (*)(const CacheRow&);

// Answers for each of these settings whether two values of the regions correlate: by at least a half, or by at most
// minus a half if they are claimed to be opposite. The noise is that of a coefficient of so few pairs (R. A. Fisher,
// Metron 1921); with three regions or fewer nothing is decided.
Judge<CacheRow> across_regions(std::vector<std::string> settings, RegionValue value, RegionValue with, bool opposite);
// Answers in the same way for the entries of each region, whose hits measure how busy it is, in one frame of all
// transmitters.
Judge<CacheRow> across_entries(std::vector<std::string> settings, double EntryGroup::*cycles);

// Answers whether a coefficient of `pairs` pairs is at least a half.
Answer correlates(double coefficient, size_t pairs);

}  // namespace wavetracer::study
