// Words and plots of the tables' operations.
// Assumes rows of one drive, as a standing world gives them.
#include "study/figures_tables.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <utility>
#include "study/ray_counts.hpp"

namespace wavetracer::study {

std::vector<uint64_t> doubling_rays() {
  std::vector<uint64_t> rays;
  for (uint64_t count = 1000; count < 20480000; count *= 2) rays.push_back(count);
  rays.push_back(20480000);
  return rays;
}

std::vector<uint64_t> few_doubling_rays() { return {1000, 16000, 64000}; }

NumberTable operations_table(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings,
                             bool with_trace) {
  NumberTable table{.caption = fmt::format("Nanoseconds a segment, at {} rays:", grouped(rows.front().rays)),
                    .heads = {"setting", "write", "read", "gather"},
                    .rows = {}};
  if (with_trace) table.heads.emplace_back("trace");
  for (const std::string& setting : settings) {
    const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive);
    if (!row) continue;
    table.rows.push_back({setting, plain(write_ns(*row)), plain(read_ns(*row)), plain(gather_ns(*row))});
    if (with_trace) table.rows.back().push_back(plain(trace_ns(*row)));
  }
  return table;
}

std::string settings_verdict(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings,
                             const std::function<bool(const CacheRow&)>& holds) {
  std::vector<std::string> yes, no;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive))
      (holds(*row) ? yes : no).push_back('"' + setting + '"');
  if (no.empty()) return yes.empty() ? "not measured" : "confirmed for all";
  return yes.empty() ? "not confirmed for any"
                     : fmt::format("confirmed for {}, not for {}", list_words(yes), list_words(no));
}

std::vector<Verdict> trace_verdicts(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings) {
  return {{"tracing takes longer than a read",
           settings_verdict(rows, settings, [](const CacheRow& row) { return trace_ns(row) > read_ns(row); })},
          {"tracing takes longer than ten reads",
           settings_verdict(rows, settings, [](const CacheRow& row) { return trace_ns(row) > 10 * read_ns(row); })},
          {"tracing takes longer than a write",
           settings_verdict(rows, settings, [](const CacheRow& row) { return trace_ns(row) > write_ns(row); })}};
}

Findings operations_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request,
                             const std::vector<std::string>& settings, Words words, bool with_trace) {
  words.numbers = operations_table(measured.rows, settings, with_trace);
  std::vector<LinePanel> panels = {{"write (cache_store)", "write_ns", "ns a segment", "", with_trace},
                                   {"read (cache_lookup)", "read_ns", "ns a segment", "", with_trace},
                                   {"gather missed rays", "gather_ns", "ns a segment", "", with_trace}};
  if (with_trace) panels.push_back({"trace", "trace_ns", "ns a segment", "", true});
  LinePlot plot;
  plot.settings = settings;
  plot.x = "depth";
  plot.x_label = "depth of the segment in its path";
  plot.depths = true;
  plot.panels_a_row = with_trace ? 2 : 3;
  plot.panels = panels_of(measured.rows, panels);
  Findings found = cache_findings(recipe, measured, request, std::move(words), plot,
                                  "Time a segment of the cache's operations against the depth of the segment");
  found.notes.push_back(
      "the thesis draws its times over the entries of the table, by clocks inside the kernel, which are no timers; "
      "here a depth is what a frame that ends there takes more than one that ends before, which "
      "for the few segments of deep paths is a small difference of large numbers and can come out negative; a row of "
      "depth 0 is all of a frame. The hash is part of both read and write. The thesis' buffer call, the address of an "
      "entry, has no counterpart; what a table costs besides is the gathering of missed rays");
  return found;
}

Findings time_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request, Words words) {
  LinePlot plot;
  plot.x = "rays";
  plot.x_label = "rays";
  plot.log_x = true;
  plot.panels = panels_of(measured.rows, {{"time, table warm", "warm_s", "s a frame", "", true},
                                          {"time, table empty before", "cold_s", "s a frame", "", true}});
  return cache_findings(recipe, measured, request, std::move(words), plot,
                        "Time of a frame against the number of rays");
}

std::string fastest(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings, uint64_t rays,
                    const std::string& drive) {
  const CacheRow* best = nullptr;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, rays, drive);
        row && (!best || row->warm.loop_s < best->warm.loop_s))
      best = row;
  return best ? best->setting : "";
}

bool any_saves(const std::vector<CacheRow>& rows, const std::vector<std::string>& settings, uint64_t rays,
               const std::string& drive) {
  const CacheRow* best = find_cached(rows, fastest(rows, settings, rays, drive), rays, drive);
  return best && best->saved_percent >= 0.5;
}

}  // namespace wavetracer::study
