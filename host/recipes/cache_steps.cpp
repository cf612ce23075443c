// cache-division and cache-step: what the two quantisations of a cache trade, cells of directions and of positions.
// Both launch rays along a Hilbert curve, so that the frame without a cache is as fast as it gets without a sort.
#include <fmt/format.h>
#include <algorithm>
#include <utility>
#include "recipes/cache_words.hpp"
#include "recipes/ray_counts.hpp"
#include "recipes/recipe.hpp"

namespace wavetracer::recipes {
namespace {

// The same setting with room for all segments, along a Hilbert curve, one key changed.
Setting varied(const std::string& name, const Setting& base, const std::function<void(CacheConfig&)>& change) {
  return {name, [apply = base.apply, change](Config& config) {
            apply(config);
            config.trace.directions = "hilbert";
            config.cache.buffer_size = std::max<uint64_t>(uint64_t{1} << 20, 8 * *config.trace.rays);
            change(config.cache);
          }};
}

std::vector<Setting> divisions() {
  std::vector<Setting> settings = {born_in_order()};
  for (const uint32_t division : {100u, 1000u, 10000u, 100000u, 1000000u}) {
    const auto set = [division](CacheConfig& cache) { cache.division = division; };
    settings.push_back(varied("concurrent static", ours(), set));
    settings.push_back(varied("concurrent all", ours(), [division](CacheConfig& cache) {
      cache.division = division;
      cache.scope = "all";
      cache.hit_point = "cached";
    }));
    settings.push_back(varied("open all", open_readers(3), set));
    settings.push_back(varied("chained all", chained(3), set));
  }
  return settings;
}

std::vector<Setting> steps() {
  std::vector<Setting> settings = {born_in_order()};
  for (const double step_m : {0.01, 0.1, 1.0, 10.0}) {
    const auto set = [step_m](CacheConfig& cache) { cache.position_step_m = step_m; };
    settings.push_back(varied("concurrent static", ours(), set));
    settings.push_back(varied("open all", position(), set));
  }
  return settings;
}

// Of the rows of a drive and number of rays, the one that saves most and yet loses at most `lost_power`; null: none.
const CacheRow* best_within(const std::vector<CacheRow>& rows, const std::string& drive, uint64_t rays,
                            double lost_power) {
  const CacheRow* best = nullptr;
  for (const CacheRow& row : rows)
    if (row.drive == drive && row.rays == rays && row.setting != rows.front().setting &&
        row.error.lost_power <= lost_power && (!best || row.saved_percent > best->saved_percent))
      best = &row;
  return best;
}

// The setting that saves most of those that lose little enough, for each world, number of rays and loss.
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

Findings show(const Recipe& recipe, const CacheMeasurement& measured, const Request& request, const std::string& x,
              const std::string& x_label, Words words) {
  std::vector<std::string> shown = settings_of(measured.rows);
  shown.erase(shown.begin());  // what the others are measured by
  LinePlot plot;
  plot.settings = shown;
  plot.x = x;
  plot.x_label = x_label;
  plot.log_x = true;
  plot.only_rays = rays_of(measured.rows).back();
  plot.panels = panels_of(measured.rows, {{"time saved", "saved_percent", "%", ""},
                                          {"look-ups answered", "hit_rate", "share", ""},
                                          {"lost power", "lost_power", "share", "", true, 1e-7},
                                          {"lost paths", "lost_share", "share", "", true, 1e-5}});
  return cache_findings(recipe, measured, request, std::move(words), plot, "Speed against error of the quantisation");
}

Findings show_divisions(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const std::string paragraph = fmt::format(
      "The thesis chooses 200,000 and 10,000 cells a direction component and gives no reason. Measured on {}, against "
      "rays along a Hilbert curve without a cache.",
      measured.device.name);
  const auto division = [](const CacheRow& row) { return grouped(row.division); };
  return show(recipe, measured, request, "division", "division (cells a direction component)",
              {paragraph, {}, trade_table(measured.rows, "division", division)});
}

Findings show_steps(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const std::string paragraph = fmt::format(
      "The thesis quantises the transmitter's position and does not say how finely (section 3.2.3). Measured on {}, "
      "against rays along a Hilbert curve without a cache.",
      measured.device.name);
  const auto step = [](const CacheRow& row) { return fmt::format("{:g} m", row.position_step_m); };
  return show(recipe, measured, request, "position_step_m", "step of the transmitter's position key (m)",
              {paragraph, {}, trade_table(measured.rows, "step", step)});
}

}  // namespace

std::vector<Recipe> cache_steps() {
  const auto by_division = std::make_shared<const CacheStudy>(CacheStudy{.name = "cache-division",
                                                                         .settings = divisions(),
                                                                         .rays = {100000, 1000000, 10000000},
                                                                         .few_rays = {100000},
                                                                         .drives = {"fixed", "spheres"},
                                                                         .at_once = 4,
                                                                         .most_frames = 50});
  const auto by_step = std::make_shared<const CacheStudy>(CacheStudy{.name = "cache-step",
                                                                     .settings = steps(),
                                                                     .rays = {49000, 1000000},
                                                                     .few_rays = {49000},
                                                                     .drives = {"moving"},
                                                                     .at_once = 4,
                                                                     .most_frames = 50});
  return {{.name = "cache-division",
           .doc = "speed, hits and error of caches against the cells of their directions",
           .title = "Cells of directions",
           .series = {},
           .study = by_division,
           .view = show_divisions},
          {.name = "cache-step",
           .doc = "speed, hits and error of caches against the step of a moving transmitter's position key",
           .title = "Steps of the transmitter's position key",
           .series = {},
           .study = by_step,
           .view = show_steps}};
}

}  // namespace wavetracer::recipes
