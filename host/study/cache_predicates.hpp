// SPDX-License-Identifier: Apache-2.0
// Predicates on rows of caches at one number of rays in one world, from which claims are made.
// set_savings() must have run. A row that was not measured makes the answer absent.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/judgement.hpp"
#include "study/measured.hpp"

namespace wavetracer::study {

using CacheRows = std::vector<CacheRow>;
using CacheValue = Measured (*)(const CacheRow&);

Measured warm_s(const CacheRow& row);
Measured once_s(const CacheRow& row);  // the same with the sort counted once, as the thesis counts it
Measured l2_m(const CacheRow& row);
Measured l2_relative(const CacheRow& row);  // relative to the mean length of paths

// A world and a number of rays, which most claims are about.
struct CachePoint {
  std::string drive;
  uint64_t rays;
};

// An answer with the number behind it.
struct Answered {
  Answer answer = Answer::absent;
  double value = undefined;
  std::string note = {};  // stands for the value
};

// A predicate, and how its values are written.
struct AtPoint {
  std::function<Answered(const CacheRows&, const CachePoint&)> at;
  ValueForm form = time_form();
};

// The fastest of `settings` takes less time than no cache. Values are times over that of no cache.
AtPoint saves(std::vector<std::string> settings);
AtPoint saves_not(std::vector<std::string> settings);
// A setting saves this share of the time of no cache; more may be beyond it.
AtPoint saves_percent(const std::string& setting, double claimed);
// Each of these settings takes less time than no cache; the value is that of the slowest.
AtPoint all_save(std::vector<std::string> settings);
// Each of these settings takes the time of no cache, within this share of it; the value is the farthest from it.
AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent);
// `setting` takes less time, or more, than every other of `settings` that was measured. The value is its time over that
// of the next one.
AtPoint fastest_is(const std::string& setting, const std::vector<std::string>& settings);
AtPoint slowest_is(const std::string& setting, const std::vector<std::string>& settings);
// Each of `largest` has a larger value than each of `others` that is not among them. The value is the least of the
// former over the greatest of the latter.
AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others);
// The value of one setting, times `factor`, is below that of another. The value is that of the one over the other's.
AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor = 1);
// The value is at most this, in `form`.
AtPoint at_most(CacheValue value, const std::string& setting, double bound, const ValueForm& form);

// Returns the fastest of `settings` there, or null if there is none.
const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at);
// Returns the time of a row over that of the first setting at the same point, which has no cache.
Measured share_of_none(const CacheRows& rows, const CacheRow& row);

}  // namespace wavetracer::study
