// Rows to phrases, and what goes into every report on caching.
// Assumes that set_savings() has run.
#include "study/cache_words.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

std::string percent(double value) { return fmt::format("{:.{}f}%", value, std::abs(value) < 9.95 ? 1 : 0); }

std::vector<std::string> summary_row(const CacheRow& row) {
  const study::PathError& e = row.error;
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
  cells.push_back(e.lost_power > 0
                      ? fmt::format("{} ({:.1f} dB)", share_words(e.lost_power), study::share_db(e.lost_power))
                      : "none");
  cells.push_back(share_words(e.spurious_share));
  cells.push_back(off(e.delay_spread_ns, "ns"));
  cells.push_back(off(e.l2_m, "m"));
  return cells;
}

}  // namespace

std::string saved_words(double percentage) {
  if (std::abs(percentage) < 0.5) return "the same time";
  return percent(std::abs(percentage)) + (percentage > 0 ? " less time" : " more time");
}

std::string share_words(double share) {
  if (std::isnan(share)) return "an undefined share";
  if (share == 0) return "none";
  return 100 * share < 9.95 ? plain(100 * share, 2) + "%" : percent(100 * share);
}

std::string verdict(bool holds) { return holds ? "confirmed" : "not confirmed"; }

std::string list_words(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds) {
  std::vector<std::string> found;
  for (const uint64_t count : rays)
    if (holds(count)) found.push_back(grouped(count));
  if (found.empty()) return "at none of the numbers of rays";
  if (found.size() == rays.size() && rays.size() > 1) return "at every number of rays";
  return "at " + list_words(found) + " rays";
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
    std::stable_sort(found.begin(), found.end(),
                     [](const CacheRow* a, const CacheRow* b) { return a->saved_percent > b->saved_percent; });
    for (const CacheRow* row : found) table.rows.push_back(summary_row(*row));
  }
  return table;
}

std::string drive_words(const std::string& drive) {
  if (drive == "spheres") return "fixed transmitter, reception by spheres";
  return drive == "fixed" || drive == "moving" ? drive + " transmitter" : drive + " world";
}

std::string each_drive(const std::vector<CacheRow>& rows, const std::function<std::string(const std::string&)>& words) {
  std::string text;
  for (const std::string& drive : drives_of(rows))
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", drive_words(drive), words(drive));
  return text;
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

std::vector<std::string> study_notes(const CacheMeasurement& measured, const Request& request) {
  std::vector<std::string> notes;
  if (measured.frames > 0)
    notes.push_back(
        fmt::format("times and errors: averages of equation 6.2 over {} frames after the first, which "
                    "finds the table empty; the thesis averages 500 cycles",
                    measured.frames));
  else
    notes.push_back(
        fmt::format("times: medians of {} frames with an empty table (cold) and of as many after them "
                    "(warm); shares and savings are of the warm ones",
                    request.repeats));
  notes.push_back(
      "device time from profiling events, the settings in turns: all stages that discover, from generate_rays and the "
      "order to interact, with cache_lookup, cache_gather, cache_store and cache_purge");
  notes.push_back(
      "errors: against the same frame with the same rays and no cache; paths pair by ends and sequence of surfaces. "
      "Where reception is exact, each path is solved and visible whatever led to it, so those that only the cached "
      "frame finds are no false ones");
  notes.push_back(
      fmt::format("the thesis does not say how far a transmitter moves until its entries are stale; here "
                  "{:g} m, unless the table says otherwise",
                  thesis_position_step_m));
  return notes;
}

Findings cache_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request, Words words,
                        LinePlot plot, const std::string& caption) {
  plot.name = recipe.name;
  plot.title = recipe.title + ", " + measured.device.name;
  Findings found;
  if (plot.columns.empty()) {
    plot.columns = cache_columns();
    found.table = encode_cache_table(measured.rows);
  }
  if (plot.settings.empty()) plot.settings = settings_of(measured.rows);
  found.device = measured.device;
  found.script = line_plot_script(plot);
  if (words.numbers.rows.empty()) words.numbers = summary_table(measured.rows);
  found.words = std::move(words);
  found.caption = caption;
  found.notes = study_notes(measured, request);
  found.points = measured.points;
  found.planned = measured.planned;
  return found;
}

}  // namespace wavetracer::study
