// SPDX-License-Identifier: Apache-2.0
// The claims about tracing one ray per group, as judges of rows: one row for each setting, C_E and number of rays.
// The first row of a number of rays must have no cache, and set_savings() must have run.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/claim.hpp"

namespace wavetracer::study {

// For settings that never hand a hit to a ray on another plane: as many segments are traced as there are groups, on
// average over frames. Answers for each number of rays; the value is the former over the latter.
Judge<CacheRow> one_ray_a_group(std::vector<std::string> settings);
// Answers for each number of rays whether one of the settings takes less time than no cache and loses at most this
// share of the paths. The value is the least time over that of no cache.
Judge<CacheRow> somewhere_faster(std::vector<std::string> settings, double lost_share);
// Answer whether the most that any row saves is at least this factor.
Judge<CacheRow> fewer_traced_times(double claimed);
Judge<CacheRow> times_as_fast(double claimed);
// Answers for each number of rays whether the largest C_E of every setting loses more paths than its smallest.
Judge<CacheRow> error_grows(std::vector<std::string> settings);
// Answers for each setting whether at equal C_E the shares of lost paths at all numbers of rays are within a factor of
// `factor` of each other, or all below `negligible`. The value is the largest such factor.
Judge<CacheRow> error_is_controlled(std::vector<std::string> settings, double factor, double negligible);

}  // namespace wavetracer::study
