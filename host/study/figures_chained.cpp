// Figures 6.2 to 6.5: the chained table in a standing scene.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.1, "Analysis of Chained Table Performance".
#include <fmt/format.h>
#include <numeric>
#include "study/figures_tables.hpp"
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t large_buffer = 10 * thesis_chained_buffer;

Setting counted(Setting setting) {
  return {setting.name + " counted", [apply = setting.apply](Config& config) {
            apply(config);
            config.cache.statistics = true;
          }};
}

std::vector<std::string> names(const std::vector<Setting>& settings) {
  std::vector<std::string> out;
  for (const Setting& setting : settings) out.push_back(setting.name);
  return out;
}

std::vector<Setting> thesis_tables() { return {chained(1), chained(2), chained(3)}; }

std::shared_ptr<const CacheStudy> anatomy() {
  CacheStudy study{.name = "chained-operations",
                   .settings = {no_cache()},
                   .rays = {anatomy_rays},
                   .few_rays = {anatomy_rays},
                   .by_depth = true};
  for (const Setting& setting : thesis_tables()) study.settings.push_back(setting);
  return std::make_shared<const CacheStudy>(study);
}

// Apart from the operations, whose times counting would change.
std::shared_ptr<const CacheStudy> hits() {
  CacheStudy study{
      .name = "chained-hits", .settings = {no_cache()}, .rays = {anatomy_rays}, .few_rays = {anatomy_rays}};
  for (const Setting& setting : thesis_tables()) study.settings.push_back(counted(setting));
  return std::make_shared<const CacheStudy>(study);
}

Findings show_operations(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const std::vector<std::string> tables = names(thesis_tables());
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "The thesis finds writes to the chained table to take longer than reads (at most 120 ms against 50 ms in its "
      "buckets, 80 against 40 in other nodes), and calls of the buffer next to nothing (section 6.3.1, figure 6.2). "
      "Measured on {} at {} rays. What the table adds besides is the gathering of missed rays.",
      measured.device.name, grouped(rows.front().rays));
  const std::vector<Verdict> verdicts = {
      {"writes take longer than reads",
       settings_verdict(rows, tables, [](const CacheRow& row) { return write_ns(row) > read_ns(row); })},
      {"the rest takes next to nothing: gathering less than a tenth of a write",
       settings_verdict(rows, tables, [](const CacheRow& row) { return gather_ns(row) < 0.1 * write_ns(row); })}};
  return operations_findings(recipe, measured, request, tables, {paragraph, verdicts}, false);
}

Findings show_tracing(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const std::vector<std::string> tables = names(thesis_tables());
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "The thesis finds tracing a segment to take almost 2 s at most, more than ten times what a write takes and far "
      "more than a read (section 6.3.1, figure 6.3). Measured on {} at {} rays. A cache can "
      "only save time where a read is cheaper than tracing.",
      measured.device.name, grouped(rows.front().rays));
  return operations_findings(recipe, measured, request, tables, {paragraph, trace_verdicts(rows, tables)}, true);
}

// "0", "1", "2", "3-4", "5-8", ...: the fewest and most hits of a class of CacheSummary::entries_by_hits.
std::pair<uint64_t, uint64_t> hits_of_class(size_t index) {
  if (index < 2) return {index, index};
  return {(uint64_t{1} << (index - 2)) + 1, uint64_t{1} << (index - 1)};
}

Findings show_hits(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  std::string table = "drive,setting,hits_from,hits_to,entries\n";
  NumberTable numbers{.caption = "Entries of the table:",
                      .heads = {"setting", "all", "that hold a segment", "of these, that never answered"},
                      .rows = {}};
  std::vector<std::string> shown;
  bool some_unused = true, fragmented = true, any = false;
  for (const Setting& setting : thesis_tables()) {
    const std::string name = counted(setting).name, &drive = measured.rows.front().drive;
    const CacheRow* row = find_cached(measured.rows, name, measured.rows.front().rays, drive);
    if (!row || row->cache.entries_by_hits.empty()) continue;
    const std::vector<uint64_t>& entries = row->cache.entries_by_hits;
    any = true;
    shown.push_back(name);
    for (size_t i = 0; i < entries.size(); ++i) {
      const auto [from, to] = hits_of_class(i);
      table += fmt::format("{},{},{},{},{}\n", drive, name, from, to, entries[i]);
    }
    const uint64_t used = std::accumulate(entries.begin(), entries.end(), uint64_t{0});
    some_unused = some_unused && entries.front() > 0;
    fragmented = fragmented && used < row->cache.entries;
    numbers.rows.push_back({setting.name, grouped(row->cache.entries), grouped(used), grouped(entries.front())});
  }
  LinePlot plot;
  plot.columns = {"drive", "setting", "hits_from", "hits_to", "entries"};
  plot.settings = shown;
  plot.x = "hits_to";
  plot.x_label = "hits of an entry, at most";
  plot.panels_a_row = 1;
  plot.panels = {{"entries by their hits", "entries", "entries", measured.rows.front().drive}};
  Findings found = cache_findings(
      recipe, measured, request,
      {fmt::format("The thesis finds hits spread evenly over the entries, entries of the buffer that are never used, "
                   "and some that are but never answer (section 6.3.1, figure 6.4). Measured on {} at {} rays, after a "
                   "cold frame and a warm one.",
                   measured.device.name, grouped(measured.rows.front().rays)),
       {{"some entries are left unused", any ? verdict(fragmented) : "not measured"},
        {"some entries never answer", any ? verdict(some_unused) : "not measured"}},
       numbers},
      plot, "Entries of the chained table by the hits they had");
  found.table = table;
  return found;
}

Findings show_times(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const std::vector<std::string> tables = names(thesis_tables());
  const auto& rows = measured.rows;
  const std::vector<uint64_t> rays = rays_of(rows);
  const auto saves = [&](uint64_t count) { return any_saves(rows, tables, count, rows.front().drive); };
  std::vector<uint64_t> window, outside;
  for (const uint64_t count : rays) (count >= 2560000 && count <= 10240000 ? window : outside).push_back(count);
  const auto holds = [&](const std::vector<uint64_t>& counts, bool expected) {
    return counts.empty() ? "not measured" : verdict(std::all_of(counts.begin(), counts.end(), [&](uint64_t count) {
      return saves(count) == expected;
    }));
  };
  const std::string paragraph = fmt::format(
      "The thesis finds no chained cache of {} entries faster than none, whatever the hash, but between 2,560,000 and "
      "10,240,000 rays (section 6.3.1, figure 6.5). Measured on {} with a warm table, one of them saves time {}.",
      grouped(thesis_chained_buffer), measured.device.name, where_words(rays, saves));
  return time_findings(recipe, measured, request,
                       {paragraph,
                        {{"no gain below 2,560,000 and beyond 10,240,000 rays", holds(outside, false)},
                         {"a gain from 2,560,000 to 10,240,000 rays", holds(window, true)}}});
}

}  // namespace

std::vector<Recipe> chained_figures() {
  const std::shared_ptr<const CacheStudy> operations = anatomy();
  CacheStudy times{.name = "chained-rays",
                   .settings = {no_cache()},
                   .rays = doubling_rays(),
                   .few_rays = few_doubling_rays(),
                   .at_once = 4};
  for (const Setting& setting : thesis_tables()) times.settings.push_back(setting);
  for (const uint32_t hash : {1u, 2u, 3u}) times.settings.push_back(chained(hash, large_buffer));
  times.settings.push_back(ours());
  times.settings.push_back(born_in_order());
  return {{.name = "figure-6.2",
           .doc = "chained cache: what a write and a read of a segment take, by hash",
           .title = "Operations of the chained table",
           .series = {},
           .study = operations,
           .view = show_operations},
          {.name = "figure-6.3",
           .doc = "chained cache: writes and reads against tracing",
           .title = "Operations of the chained table and tracing",
           .series = {},
           .study = operations,
           .view = show_tracing},
          {.name = "figure-6.4",
           .doc = "chained cache: hits an entry",
           .title = "Hits of the chained table's entries",
           .series = {},
           .study = hits(),
           .view = show_hits},
          {.name = "figure-6.5",
           .doc = "chained cache against none, 1,000 to 20,480,000 rays, by hash",
           .title = "Frames with the chained table",
           .series = {},
           .study = std::make_shared<const CacheStudy>(times),
           .view = show_times}};
}

}  // namespace wavetracer::study
