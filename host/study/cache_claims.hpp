// What the thesis claims of caches, as predicates on rows.
// Assumes that set_savings() has run.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/claim.hpp"

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

// At every number of rays that is `within`, in the first world: "confirmed", "not confirmed", or "not measured" where
// there is none.
Judge<CacheRow> everywhere(AtRays within, AtPoint holds);
// Of each world: "fixed transmitter: at 1,000 and 5,000 rays; moving transmitter: at every number of rays".
// defined: a value without which a number of rays says nothing, of the first setting.
Judge<CacheRow> where(AtPoint holds, CacheValue defined = nullptr);
// Of each of these settings at the first number of rays: "confirmed for all", "not confirmed for any", "confirmed for
// "A", not for "B"".
Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<bool(const CacheRow&)> holds);
// Of all of these settings: "confirmed", "not confirmed", or "not measured" where there is none.
Judge<CacheRow> of_all(std::vector<std::string> settings, std::function<bool(const CacheRow&)> holds);
// Of each world, the mean of a value over the numbers of rays where both settings have it, as a factor of that of
// another setting: "fixed transmitter: confirmed, a factor of 3.2; ..." where it is from `low` to `high`.
Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high);
// Likewise the mean itself, in `unit`: "fixed transmitter: not confirmed, 1.3 m".
Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit);
// Of each world the value at the fewest rays: "fixed transmitter: confirmed, 7.9 m" where it is from `low` to `high`.
Judge<CacheRow> at_first(CacheValue value, const std::string& setting, double low, double high,
                         const std::string& unit);
// Of each world: the share of time that a setting saves is larger at the most rays than at the fewest.
Judge<CacheRow> saving_grows(const std::string& setting);
// In the first world: the fastest of `settings` saves most seconds at this number of rays. "not measured" without it.
Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays);
// In the first world: the fewest rays at which a setting saves time are fewer than those of another one. "confirmed,
// from 64,000 rays on; the other nowhere".
Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than);
// For a claim about times inside of a kernel, which has no timer.
Judge<CacheRow> not_judged(const std::string& why);
// One setting's value below that of another at the first number of rays: "confirmed", "not confirmed".
Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than);

// "at every number of rays", "at none of the numbers of rays", "at 1,000 and 64,000 rays": of the rays that were
// measured.
std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds);
// "fixed transmitter"
std::string drive_words(const std::string& drive);

// {device}, {rays}: the first number of rays, {saves}: where one of `settings` saves time, in the first world.
Fields cache_fields(const CacheRows& rows, const std::string& device, const std::vector<std::string>& settings);

}  // namespace wavetracer::study
