// Predicates on rows of caches at one number of rays in one world, of which claims are made.
// Assumes that set_savings() has run. A row that was not measured confirms nothing.
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
double l2_relative(const CacheRow& row);  // to the mean length of paths

// A world at a number of rays: what most claims are about.
struct CachePoint {
  std::string drive;
  uint64_t rays;
};
using AtPoint = std::function<bool(const CacheRows&, const CachePoint&)>;
using AtRays = std::function<bool(uint64_t rays)>;

// The fastest of `settings` takes at least half a percent less time than no cache.
AtPoint saves(std::vector<std::string> settings);
AtPoint saves_not(std::vector<std::string> settings);
AtPoint saves_percent(const std::string& setting, double claimed);
// Each of these settings takes at least half a percent less time than no cache.
AtPoint all_save(std::vector<std::string> settings);
// Each of these settings takes the time of no cache, within this share of it.
AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent);
// `setting` takes the least time, or the most, of all `settings` that were measured.
AtPoint fastest_is(const std::string& setting, std::vector<std::string> settings);
AtPoint slowest_is(const std::string& setting, std::vector<std::string> settings);
// None of `others`, but those of `largest` themselves, has a larger value than the least of `largest`,
// which is not 0.
AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others);
// The value of one setting, times `factor`, below that of another; both must be measured.
AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor = 1);
AtPoint at_most(CacheValue value, const std::string& setting, double bound);

// Numbers of rays.
AtRays above(uint64_t bound);
AtRays up_to(uint64_t bound);
AtRays between(uint64_t first, uint64_t last);
AtRays outside(uint64_t first, uint64_t last);

// The fastest of `settings` there; null for none.
const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at);

}  // namespace wavetracer::study
