// SPDX-License-Identifier: Apache-2.0
// Rows of a study of caching as a device would give them, with numbers that a test chooses.
// Every setting of a study gets a row at each number of rays; the first takes a second per frame.
#pragma once
#include <functional>
#include <vector>
#include "study/cache_study.hpp"

// Seconds a warm frame takes and the distance of its centroid.
using CacheCost = std::function<std::pair<double, double>(const std::string& setting, uint64_t rays)>;

inline wavetracer::study::CacheMeasurement made_measurement(const wavetracer::study::CacheStudy& study,
                                                            const std::vector<uint64_t>& counts,
                                                            const CacheCost& cost) {
  using namespace wavetracer::study;
  CacheMeasurement out;
  out.device.name = "the device";
  for (const std::string& drive : study.drives)
    for (const uint64_t rays : counts) {
      std::vector<CacheRow> point;
      for (const Setting& setting : study.settings) {
        const auto [seconds, l2_m] = cost(setting.name, rays);
        CacheRow row{.study = study.name, .drive = drive, .setting = setting.name, .rays = rays, .frames = 3};
        row.warm.loop_s = seconds;
        row.cold.loop_s = 2 * seconds;
        row.warm_error.loop_s = 0.001 * seconds;
        row.cold_counts = {100, 100, 20};
        row.counts = {100, 100, 75};
        row.error.reference_paths = 40;
        row.error.lost = l2_m > 0 ? 4 : 0;
        row.error.lost_share = l2_m > 0 ? 0.1 : 0;
        row.error.lost_power = l2_m > 0 ? 0.001 : 0;
        row.error.spurious_share = row.error.spurious_power = 0;
        row.error.delay_ns = 0;
        row.error.l1_m = row.error.l2_m = l2_m;
        row.l2_error_m = 0.001 * l2_m;
        row.error.l1_relative = row.error.l2_relative = l2_m / 100;
        row.cache.on = setting.name != study.settings.front().name;
        row.cache.entries = 50000;
        row.cache.entries_by_hits = {100, 200, 300, 400};
        if (setting.whole_only)
          row.entries = {.by_depth = {{1, 700, 1500, 130, 160, 1, 1}, {2, 300, 500, 180, 260, 1, 1}},
                         .by_region = {{0, 1000, 2000, 150, 190}},
                         .runs = {{0, 500, 2.5}, {500, 500, 1.5}},
                         .samples = {{0, 0, 1, 3, 75, 95}, {40, 0, 2, 0, 0, 380}},
                         .dispersion = 0.8,
                         .clustering = 6};
        point.push_back(row);
      }
      set_savings(point);
      out.rows.insert(out.rows.end(), point.begin(), point.end());
      ++out.points;
    }
  out.planned = out.points;
  return out;
}
