// SPDX-License-Identifier: Apache-2.0
// Predicates on rows of caches at one number of rays in one world, from which claims are made.
// set_savings() must have run. A row that was not measured confirms nothing.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"

namespace wavetracer::study {

using CacheRows = std::vector<CacheRow>;
using CacheValue = double (*)(const CacheRow&);

double warm_s(const CacheRow& row);
double l2_m(const CacheRow& row);
double l2_relative(const CacheRow& row);  // relative to the mean length of paths

// A world and a number of rays, which most claims are about.
struct CachePoint {
  std::string drive;
  uint64_t rays;
};
using AtPoint = std::function<bool(const CacheRows&, const CachePoint&)>;
using AtRays = std::function<bool(uint64_t rays)>;

// True if the fastest of `settings` takes at least half a percent less time than no cache.
AtPoint saves(std::vector<std::string> settings);
AtPoint saves_not(std::vector<std::string> settings);
AtPoint saves_percent(const std::string& setting, double claimed);
// True if each of these settings takes at least half a percent less time than no cache.
AtPoint all_save(std::vector<std::string> settings);
// True if each of these settings takes the time of no cache, within this share of it.
AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent);
// True if `setting` takes the least time, or the most, of all `settings` that were measured.
AtPoint fastest_is(const std::string& setting, std::vector<std::string> settings);
AtPoint slowest_is(const std::string& setting, std::vector<std::string> settings);
// True if none of `others`, except those of `largest` themselves, has a larger value than the least of `largest`,
// which is not 0.
AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others);
// True if the value of one setting, times `factor`, is below that of another; both must be measured.
AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor = 1);
AtPoint at_most(CacheValue value, const std::string& setting, double bound);

// Conditions on numbers of rays.
AtRays above(uint64_t bound);
AtRays up_to(uint64_t bound);
AtRays between(uint64_t first, uint64_t last);
AtRays outside(uint64_t first, uint64_t last);

// Returns the fastest of `settings` there, or null if there is none.
const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at);

}  // namespace wavetracer::study
