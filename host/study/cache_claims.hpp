// What the thesis claims of caches, as judges of rows.
// Assumes that set_savings() has run.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "study/cache_points.hpp"
#include "study/claim.hpp"

namespace wavetracer::study {

// At every number of rays that is `within`, in the first world: "confirmed", "not confirmed", or "not measured" where
// there is none.
Judge<CacheRow> everywhere(AtRays within, AtPoint holds);
// Of each world: "fixed transmitter: at 1,000 and 5,000 rays; moving transmitter: at every number of rays".
// defined: a value without which a number of rays says nothing, of the first setting.
Judge<CacheRow> where(AtPoint holds, CacheValue defined = nullptr);
// Likewise of the numbers of rays at which a setting saves this share of the time, which more can exceed.
Judge<CacheRow> where_saved(const std::string& setting, double percent);
// Of each of these settings at the first number of rays, where it can be said: "confirmed for all", "not confirmed for
// any", "confirmed for "A", not for "B"".
Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<std::optional<bool>(const CacheRow&)> holds);
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
Judgement where_judged(const std::vector<uint64_t>& rays, const AtRays& holds, const AtRays& goes_beyond = {});
// "fixed transmitter"
std::string drive_words(const std::string& drive);

// {device}, {rays}: the first number of rays, {saves}: where one of `settings` saves time, in the first world.
Fields cache_fields(const CacheRows& rows, const std::string& device, const std::vector<std::string>& settings);

}  // namespace wavetracer::study
