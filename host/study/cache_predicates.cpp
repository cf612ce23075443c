// SPDX-License-Identifier: Apache-2.0
// Predicates on rows of caches.
// Each looks its rows up by setting, number of rays and world.
#include "study/cache_predicates.hpp"
#include <algorithm>
#include <cmath>
#include "study/statistics.hpp"

namespace wavetracer::study {

const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at) {
  const CacheRow* best = nullptr;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
        row && (!best || warm_s(*row) < warm_s(*best)))
      best = row;
  return best;
}

double warm_s(const CacheRow& row) { return row.warm.loop_s; }
double l2_m(const CacheRow& row) { return row.error.l2_m; }
double l2_relative(const CacheRow& row) { return row.error.l2_relative; }

AtPoint saves(std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* best = fastest(rows, settings, at);
    return best && best->saved_percent >= 0.5;
  };
}

AtPoint saves_not(std::vector<std::string> settings) { return std::not_fn(saves(std::move(settings))); }

AtPoint saves_percent(const std::string& setting, double claimed) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
    return row && row->saved_percent >= claimed;
  };
}

AtPoint all_save(std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    return std::ranges::all_of(settings, [&](const std::string& setting) { return saves({setting})(rows, at); });
  };
}

AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    return std::ranges::all_of(settings, [&](const std::string& setting) {
      const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
      return row && std::abs(row->saved_percent) <= percent;
    });
  };
}

AtPoint slowest_is(const std::string& setting, std::vector<std::string> settings) {
  return largest_are(warm_s, {setting}, std::move(settings));
}

AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const auto value_of_one = [&](const std::string& setting) {
      const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
      return row ? value(*row) : undefined;
    };
    return std::ranges::all_of(largest, [&](const std::string& a) {
      return value_of_one(a) > 0 && std::ranges::all_of(others, [&](const std::string& b) {
               return std::ranges::find(largest, b) != largest.end() || value_of_one(a) >= value_of_one(b);
             });
    });
  };
}

AtPoint fastest_is(const std::string& setting, std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* best = fastest(rows, settings, at);
    return best && best->setting == setting;
  };
}

AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow *a = find_cached(rows, setting, at.rays, at.drive), *b = find_cached(rows, than, at.rays, at.drive);
    return a && b && factor * value(*a) < value(*b);
  };
}

AtPoint at_most(CacheValue value, const std::string& setting, double bound) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
    return row && value(*row) <= bound;
  };
}

AtRays above(uint64_t bound) {
  return [=](uint64_t rays) { return rays > bound; };
}
AtRays up_to(uint64_t bound) { return std::not_fn(above(bound)); }
AtRays between(uint64_t first, uint64_t last) {
  return [=](uint64_t rays) { return rays >= first && rays <= last; };
}
AtRays outside(uint64_t first, uint64_t last) { return std::not_fn(between(first, last)); }

}  // namespace wavetracer::study
