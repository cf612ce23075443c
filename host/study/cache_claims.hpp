// SPDX-License-Identifier: Apache-2.0
// The thesis' claims about caches, as judges of rows. Cases are numbers of rays in each world, unless a judge says
// something else. set_savings() must have run.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_predicates.hpp"
#include "study/claim.hpp"

namespace wavetracer::study {

// Answers for each world and number of rays.
Judge<CacheRow> where(AtPoint holds);
// The same for a setting that saves this share of the time; more may be beyond the claim.
Judge<CacheRow> where_saved(const std::string& setting, double percent);
// Answers for each of these settings at the first number of rays, in `form`.
Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<Answered(const CacheRow&)> holds,
                        const ValueForm& form);
// Answers for each world whether the mean of a value over the numbers of rays where both settings have it, as a factor
// of that of another setting, is from `low` to `high`.
Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high);
// Answers for each world whether the mean itself, in `unit`, is from `low` to `high`.
Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit);
// Answers for each world and number of rays whether the value is from `low` to `high`.
Judge<CacheRow> value_between(CacheValue value, const std::string& setting, double low, double high,
                              const std::string& unit);
// Answers for each world whether a setting takes a smaller share of the time of no cache at the most rays than at the
// fewest.
Judge<CacheRow> saving_grows(const std::string& setting);
// Answers for each world whether the fastest of `settings` saves more seconds at this number of rays than at any other.
Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays);
// Answers for each world whether a setting saves time from fewer rays on than another one. It is undecided where
// neither saves time.
Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than);
// Returns the judge of a claim that no measurement of this program can decide.
Judge<CacheRow> not_judged(const std::string& why);
// Answers whether one setting's value is below that of another at the first number of rays.
Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than);

using AtRays = std::function<bool(uint64_t rays)>;
// Returns "at every number of rays", "at none of the numbers of rays", or "at 1,000 and 64,000 rays", for the rays that
// were measured.
std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds);
// Returns words such as "fixed transmitter".
std::string drive_words(const std::string& drive);

// Returns the fields {device}, {rays}: the first number of rays, {saves}: where one of `settings` saves time in the
// first world.
Fields cache_fields(const CacheRows& rows, const std::string& device, const std::vector<std::string>& settings);

}  // namespace wavetracer::study
