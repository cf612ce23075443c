// SPDX-License-Identifier: Apache-2.0
// The thesis' claims about caches, as judges of rows.
// set_savings() must have run.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "study/cache_predicates.hpp"
#include "study/claim.hpp"

namespace wavetracer::study {

// Judges every number of rays that is `within`, in the first world: "confirmed", "not confirmed", or "not measured" if
// there is none.
Judge<CacheRow> everywhere(AtRays within, AtPoint holds);
// Lists for each world where the claim holds: "fixed transmitter: at 1,000 and 5,000 rays; moving transmitter: at every
// number of rays". defined: a value of the first setting without which a number of rays is skipped.
Judge<CacheRow> where(AtPoint holds, CacheValue defined = nullptr);
// Lists in the same way the numbers of rays at which a setting saves this share of the time; more may be exceeded.
Judge<CacheRow> where_saved(const std::string& setting, double percent);
// Judges each of these settings at the first number of rays where that is possible: "confirmed for all", "not confirmed
// for any", "confirmed for "A", not for "B"".
Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<std::optional<bool>(const CacheRow&)> holds);
// Judges for each world the mean of a value over the numbers of rays where both settings have it, as a factor of that
// of another setting: "fixed transmitter: confirmed, a factor of 3.2; ..." if it is from `low` to `high`.
Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high);
// Judges in the same way the mean itself, in `unit`: "fixed transmitter: not confirmed, 1.3 m".
Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit);
// Judges for each world the value at the fewest rays: "fixed transmitter: confirmed, 7.9 m" if it is from `low` to
// `high`.
Judge<CacheRow> at_first(CacheValue value, const std::string& setting, double low, double high,
                         const std::string& unit);
// Judges for each world whether the share of time that a setting saves is larger at the most rays than at the fewest.
Judge<CacheRow> saving_grows(const std::string& setting);
// Judges in the first world whether the fastest of `settings` saves most seconds at this number of rays; "not measured"
// without it.
Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays);
// Judges in the first world whether a setting starts to save time at fewer rays than another one: "confirmed, from
// 64,000 rays on; the other nowhere".
Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than);
// Returns the judge of a claim about times inside of a kernel, which has no timer.
Judge<CacheRow> not_judged(const std::string& why);
// Judges whether one setting's value is below that of another at the first number of rays: "confirmed", "not
// confirmed".
Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than);

// Returns "at every number of rays", "at none of the numbers of rays", or "at 1,000 and 64,000 rays", for the rays that
// were measured.
std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds);
Judgement where_judged(const std::vector<uint64_t>& rays, const AtRays& holds, const AtRays& goes_beyond = {});
// Returns words such as "fixed transmitter".
std::string drive_words(const std::string& drive);

// Returns the fields {device}, {rays}: the first number of rays, {saves}: where one of `settings` saves time in the
// first world.
Fields cache_fields(const CacheRows& rows, const std::string& device, const std::vector<std::string>& settings);

}  // namespace wavetracer::study
