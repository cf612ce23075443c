// What the figures of the chained and of the open table share: operations a segment, depth by depth.
// Figures 6.2, 6.3, 6.6 and 6.7 of A. Zhdanov, TU Munich, 2014.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "study/cache_words.hpp"

namespace wavetracer::study {

constexpr uint64_t anatomy_rays = 50000;

// 1,000 doubled up to the thesis' 20,480,000 at most, which is the last; and those that a CPU is asked for.
std::vector<uint64_t> doubling_rays();
std::vector<uint64_t> few_doubling_rays();

// Nanoseconds a segment to write, to read, to gather, a row a setting, of all depths together.
NumberTable operations_table(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings,
                             bool with_trace);
// Of settings for which `holds`: "confirmed for all", "for none", "for A and B, not for C".
std::string settings_verdict(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings,
                             const std::function<bool(const CacheRow&)>& holds);
// What figures 6.3 and 6.7 claim of tracing a segment against looking it up.
std::vector<Verdict> trace_verdicts(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings);
Findings operations_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request,
                             const std::vector<std::string>& settings, Words words, bool with_trace);
// Time a ray of every setting against the number of rays, warm and cold.
Findings time_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request, Words words);

// Rays at which the fastest of `settings` takes at least half a percent less time than no cache.
bool any_saves(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings, uint64_t rays,
               const std::string& drive = "still");
// The setting that takes the least time, of those measured; empty for none.
std::string fastest(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings, uint64_t rays,
                    const std::string& drive = "still");

}  // namespace wavetracer::study
