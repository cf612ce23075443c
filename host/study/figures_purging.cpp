// Figures 6.10 to 6.12: caches in traffic, purged by the transmitter's position or by precision.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "study/cache_words.hpp"
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {
namespace {

const std::string by_position = position().name, by_precision = precision(thesis_residual).name,
                  by_errors_precision = precision(thesis_residual_of_errors).name;

// The claimed saving reached at every number of rays of a drive.
std::string reached(const std::vector<CacheRow>& rows, const std::string& drive, const std::string& setting,
                    double claimed_percent) {
  return where_words(rays_of(rows), [&](uint64_t rays) {
    const CacheRow* row = find_cached(rows, setting, rays, drive);
    return row && row->saved_percent >= claimed_percent;
  });
}

Findings show_centroids(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  std::string table = "drive,setting,frame,distance_m,average_m\n";
  for (const CacheRow& row : measured.rows)
    for (const CentroidError& at : row.centroids)
      table += fmt::format("{},{},{},{:.6g},{:.6g}\n", row.drive, row.setting, at.frame, at.l2_m, at.mean_l2_m);
  const uint64_t rays = measured.rows.front().rays;
  NumberTable numbers{
      .caption = "Distance of centroids:", .heads = {"world", "setting", "on average", "at most"}, .rows = {}};
  for (const std::string& drive : drives_of(measured.rows))
    for (const std::string& setting : {by_position, by_precision})
      if (const CacheRow* row = find_cached(measured.rows, setting, rays, drive)) {
        double largest_m = 0;
        for (const CentroidError& at : row->centroids) largest_m = std::max(largest_m, at.l2_m);
        numbers.rows.push_back(
            {drive_words(drive), setting, plain(row->error.l2_m, 2) + " m", plain(largest_m, 2) + " m"});
      }
  LinePlot plot;
  plot.columns = {"drive", "setting", "frame", "distance_m", "average_m"};
  plot.settings = {by_position, by_precision};
  plot.x = "frame";
  plot.x_label = "frame";
  plot.panels = panels_of(measured.rows,
                          {{"distance", "l2_m", "m", "", false, 1e-3}, {"running mean", "l2_m", "m", "", false, 1e-3}});
  for (size_t i = 0; i < plot.panels.size(); ++i) plot.panels[i].y = i % 2 == 0 ? "distance_m" : "average_m";
  Findings found = cache_findings(
      recipe, measured, request,
      {fmt::format("Figure 6.10 of the thesis shows its program at work: the centroids of two clouds of points, their "
                   "distance in the frame and its average so far (equations 6.2 and 6.3). Here both are drawn frame by "
                   "frame, of path vertices with a cache against none. Measured on {} at {} rays.",
                   measured.device.name, grouped(rays)),
       {},
       numbers},
      plot, "Distance of centroids and its running mean");
  found.table = table;
  return found;
}

Findings show_times(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const auto where = [&](const std::string& setting, double percent) {
    return each_drive(rows, [&](const std::string& drive) { return reached(rows, drive, setting, percent); });
  };
  LinePlot plot;
  plot.x = "rays";
  plot.x_label = "rays";
  plot.log_x = true;
  plot.panels = panels_of(rows, {{"time", "warm_s", "s a frame", "", true}, {"time saved", "saved_percent", "%", ""}});
  return cache_findings(
      recipe, measured, request,
      {fmt::format("The thesis finds the open table to take 10% less time than no cache for few and medium numbers of "
                   "rays and 15% for many if purged by position, 30% and 17% by precision {:g} (section 6.3.2, figure "
                   "6.11). Measured on {}.",
                   thesis_residual, measured.device.name),
       {{"10% less time if purged by position", where(by_position, 10)},
        {"17% less time if purged by precision", where(by_precision, 17)}}},
      plot, "Average time of a frame against the number of rays");
}

Findings show_errors(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const auto l2_m = [&](const std::string& setting, uint64_t rays, const std::string& drive) {
    const CacheRow* row = find_cached(rows, setting, rays, drive);
    return row ? row->error.l2_m : study::undefined;
  };
  using Holds = std::function<bool(uint64_t rays, const std::string& drive)>;
  const auto where = [&](const Holds& holds) {
    return each_drive(rows, [&](const std::string& drive) -> std::string {
      std::vector<uint64_t> rays = rays_of(rows);
      std::erase_if(rays, [&](uint64_t n) { return std::isnan(l2_m(rows.front().setting, n, drive)); });
      if (rays.empty()) return "no path has a vertex";
      return where_words(rays, [&](uint64_t n) { return holds(n, drive); });
    });
  };
  const std::vector<Verdict> verdicts = {
      {"off by 2 m at most if purged by position",
       where([&](uint64_t n, const std::string& drive) { return l2_m(by_position, n, drive) <= 2; })},
      {fmt::format("off by 7 m at most by precision {:g}", thesis_residual_of_errors),
       where([&](uint64_t n, const std::string& drive) { return l2_m(by_errors_precision, n, drive) <= 7; })},
      {"off farther by precision than by position", where([&](uint64_t n, const std::string& drive) {
         return l2_m(by_errors_precision, n, drive) > l2_m(by_position, n, drive);
       })}};
  LinePlot plot;
  plot.x = "rays";
  plot.x_label = "rays";
  plot.log_x = true;
  plot.panels_a_row = 3;
  plot.panels = panels_of(rows, {{"centroid, L2", "l2_m", "m", "", false, 1e-3},
                                 {"lost paths", "lost_share", "share", "", false, 1e-3},
                                 {"lost power", "lost_power", "share", "", true, 1e-7}});
  return cache_findings(
      recipe, measured, request,
      {fmt::format(
           "The thesis finds the centroid of the points to be off by 2 units at most if purged by position, but "
           "for 8 at the first number of rays, and by 7 at most by precision {:g}, three times as far on "
           "average, and leaves open what a unit is to a path (section 6.3.2, figure 6.12). Measured on {}, of "
           "path vertices in metres.",
           thesis_residual_of_errors, measured.device.name),
       verdicts},
      plot, "Error against the number of rays");
}

}  // namespace

std::vector<Recipe> purging_figures() {
  const auto centroids =
      std::make_shared<const CacheStudy>(CacheStudy{.name = "centroids",
                                                    .settings = {no_cache(), position(), precision(thesis_residual)},
                                                    .rays = {claimed_many},
                                                    .few_rays = {claimed_many},
                                                    .drives = {"fixed", "moving", "spheres"},
                                                    .centroids = true});
  const auto purging = std::make_shared<const CacheStudy>(
      CacheStudy{.name = "purging",
                 .settings = {no_cache(), position(), precision(thesis_residual), precision(thesis_residual_of_errors),
                              ours(), exact(), reuse_instead()},
                 .rays = {1000, 5000, 10000, 20000, 30000, 49000, 70000, 90000, 200000, 500000, 900000},
                 .few_rays = {1000, 10000, 49000},
                 .drives = {"fixed", "moving", "spheres"}});
  return {{.name = "figure-6.10",
           .doc = "traffic: distance of centroids with a cache from those without, frame by frame",
           .title = "Distance of centroids",
           .series = {},
           .study = centroids,
           .view = show_centroids},
          {.name = "figure-6.11",
           .doc = "traffic: time with position purging, precision purging and no cache",
           .title = "Frames in traffic by purging",
           .series = {},
           .study = purging,
           .view = show_times},
          {.name = "figure-6.12",
           .doc = "traffic: error with position purging and precision purging",
           .title = "Errors in traffic by purging",
           .series = {},
           .study = purging,
           .view = show_errors}};
}

}  // namespace wavetracer::study
