// SPDX-License-Identifier: Apache-2.0
// Turns rows into plots and tables of numbers.
// set_savings() must have run.
#include "study/cache_views.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/cache_claims.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

LinePlot by_rays(const CacheMeasurement& measured, const std::vector<LinePanel>& panels) {
  return {.x = "rays",
          .x_label = "rays",
          .log_x = true,
          .panels_a_row = static_cast<uint32_t>(panels.size()),
          .panels = panels_of(measured.rows, panels)};
}

// Returns, among the rows of a drive and number of rays, the one that saves most and loses at most `lost_power`; null
// if there is none.
const CacheRow* best_within(const std::vector<CacheRow>& rows, const std::string& drive, uint64_t rays,
                            double lost_power) {
  const CacheRow* best = nullptr;
  for (const CacheRow& row : rows)
    if (row.drive == drive && row.rays == rays && row.setting != rows.front().setting &&
        row.error.lost_power <= lost_power && (!best || row.saved_percent > best->saved_percent))
      best = &row;
  return best;
}

// Shows for each world, number of rays and loss the setting that saves most among those that lose little enough.
NumberTable trade_table(const std::vector<CacheRow>& rows, const std::string& head,
                        const std::function<std::string(const CacheRow&)>& value) {
  NumberTable table{.caption = "The fastest of those that lose little enough:",
                    .heads = {"world", "rays", "power lost at most", "setting", head, "time", "look-ups answered"},
                    .rows = {}};
  for (const std::string& drive : drives_of(rows))
    for (const uint64_t rays : rays_of(rows))
      for (const double bound : {1e-2, 1e-3, 1e-4}) {
        table.rows.push_back({drive_words(drive), grouped(rays), share_words(bound)});
        if (const CacheRow* row = best_within(rows, drive, rays, bound))
          for (const std::string& cell :
               {row->setting, value(*row), saved_words(row->saved_percent), share_words(hit_rate(*row))})
            table.rows.back().push_back(cell);
        table.rows.back().resize(table.heads.size(), "none");
      }
  return table;
}

std::vector<std::string> summary_row(const CacheRow& row) {
  const PathError& e = row.error;
  std::vector<std::string> cells = {drive_words(row.drive), row.setting, saved_words(row.saved_percent),
                                    row.cache.on ? share_words(hit_rate(row)) : "no cache"};
  if (e.reference_paths == 0) {
    cells.resize(9, "no paths");
    return cells;
  }
  const auto off = [](double value, const char* unit) {
    return std::isnan(value) ? "undefined" : value == 0 ? "right" : fmt::format("{} {}", plain(value, 2), unit);
  };
  cells.push_back(share_words(e.lost_share));
  cells.push_back(e.lost_power > 0 ? fmt::format("{} ({:.1f} dB)", share_words(e.lost_power), share_db(e.lost_power))
                                   : "none");
  cells.push_back(share_words(e.spurious_share));
  cells.push_back(off(e.delay_spread_ns, "ns"));
  cells.push_back(off(e.l2_m, "m"));
  return cells;
}

}  // namespace

CacheShown times_by_rays(const CacheMeasurement& measured) {
  return {by_rays(measured, {{"time, table warm", "warm_s", "s per frame", "", true},
                             {"time, table empty before", "cold_s", "s per frame", "", true}})};
}

CacheShown savings_by_rays(const CacheMeasurement& measured) {
  return {by_rays(measured, {{"time", "warm_s", "s per frame", "", true}, {"time saved", "saved_percent", "%", ""}})};
}

CacheShown errors_by_rays(const CacheMeasurement& measured) {
  return {by_rays(measured, {{"centroid, L2", "l2_m", "m", "", false, 1e-3},
                             {"lost paths", "lost_share", "share", "", false, 1e-3},
                             {"lost power", "lost_power", "share", "", true, 1e-7}})};
}

CacheView centroids(std::vector<std::string> settings) {
  return [=](const CacheMeasurement& measured) {
    const std::vector<LinePanel> panels = {{"distance", "l2_m", "m", "", false, 1e-3},
                                           {"running mean", "l2_m", "m", "", false, 1e-3}};
    CacheShown out{
        .plot = {.settings = settings, .x = "frame", .x_label = "frame", .panels = panels_of(measured.rows, panels)},
        .table = Csv({"drive", "setting", "frame", "distance_m", "average_m"}),
        .numbers = {
            .caption = "Distance of centroids:", .heads = {"world", "setting", "on average", "at most"}, .rows = {}}};
    for (size_t i = 0; i < out.plot.panels.size(); ++i) out.plot.panels[i].y = i % 2 == 0 ? "distance_m" : "average_m";
    for (const CacheRow& row : measured.rows)
      for (const CentroidError& at : row.centroids)
        out.table.add(row.drive, row.setting, at.frame, six_digits(at.l2_m), six_digits(at.mean_l2_m));
    for (const std::string& drive : drives_of(measured.rows))
      for (const std::string& setting : settings)
        if (const CacheRow* row = find_cached(measured.rows, setting, measured.rows.front().rays, drive)) {
          double largest_m = 0;
          for (const CentroidError& at : row->centroids) largest_m = std::max(largest_m, at.l2_m);
          out.numbers.rows.push_back(
              {drive_words(drive), setting, plain(row->error.l2_m, 2) + " m", plain(largest_m, 2) + " m"});
        }
    return out;
  };
}

CacheView trade(const std::string& column, const std::string& label, const std::string& head,
                std::function<std::string(const CacheRow&)> value) {
  return [=](const CacheMeasurement& measured) -> CacheShown {
    std::vector<std::string> shown = settings_of(measured.rows);
    shown.erase(shown.begin());  // the reference of the others
    return {.plot = {.settings = shown,
                     .x = column,
                     .x_label = label,
                     .log_x = true,
                     .only_rays = rays_of(measured.rows).back(),
                     .panels = panels_of(measured.rows, {{"time saved", "saved_percent", "%", ""},
                                                         {"look-ups answered", "hit_rate", "share", ""},
                                                         {"lost power", "lost_power", "share", "", true, 1e-7},
                                                         {"lost paths", "lost_share", "share", "", true, 1e-5}})},
            .numbers = trade_table(measured.rows, head, value)};
  };
}

NumberTable summary_table(const std::vector<CacheRow>& rows) {
  const uint64_t most = rays_of(rows).back();
  NumberTable table{.caption = fmt::format("At {} rays, against the same rays without a cache:", grouped(most)),
                    .heads = {"world", "setting", "time", "look-ups answered", "lost paths", "lost power",
                              "spurious paths", "delay spread", "centroid"},
                    .rows = {}};
  for (const std::string& drive : drives_of(rows)) {
    std::vector<const CacheRow*> found;
    for (const std::string& setting : settings_of(rows))
      if (const CacheRow* row = find_cached(rows, setting, most, drive); row && setting != rows.front().setting)
        found.push_back(row);
    std::ranges::stable_sort(found, std::greater{}, &CacheRow::saved_percent);
    for (const CacheRow* row : found) table.rows.push_back(summary_row(*row));
  }
  return table;
}

std::vector<LinePanel> panels_of(const std::vector<CacheRow>& rows, const std::vector<LinePanel>& a_drive) {
  const std::vector<std::string> drives = drives_of(rows);
  std::vector<LinePanel> panels;
  for (const std::string& drive : drives)
    for (LinePanel panel : a_drive) {
      if (std::none_of(rows.begin(), rows.end(), [&](const CacheRow& row) {
            return row.drive == drive && std::isfinite(value_of(row, panel.y));
          }))
        continue;
      if (drives.size() > 1) panel.title += " (" + drive + ")";
      panel.drive = drive;
      panels.push_back(panel);
    }
  return panels;
}

std::vector<std::string> study_notes(const CacheMeasurement& measured, uint32_t repeats) {
  return {measured.frames > 0
              ? fmt::format("times and errors: averages of equation 6.2 over {} frames after the first, "
                            "which finds the table empty; the thesis averages 500 cycles",
                            measured.frames)
              : fmt::format("times: medians of {} frames with an empty table (cold) and of as many after them (warm); "
                            "shares and savings are of the warm ones",
                            repeats),
          "device time from profiling events, the settings in turns: all stages that discover, from generate_rays "
          "and the order to interact, with cache_lookup, cache_gather, cache_store and cache_purge",
          "errors: against the same frame with the same rays and no cache; paths pair by ends "
          "and sequence of surfaces. "
          "Where reception is exact, each path is solved and visible whatever led to it, so those "
          "that only the cached frame finds are no false ones",
          fmt::format("the thesis does not say how far a transmitter moves until its entries are stale; here {:g} m, "
                      "unless the table says otherwise",
                      thesis_position_step_m)};
}

}  // namespace wavetracer::study
