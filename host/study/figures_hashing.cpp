// Figures 6.14 to 6.17: hash functions in traffic, time and error, without and with rays in order.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.2.
#include <fmt/format.h>
#include <algorithm>
#include "study/cache_words.hpp"
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {
namespace {

std::vector<Setting> by_hash() {
  std::vector<Setting> settings = {no_cache()};
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(position(hash));
  for (const uint32_t hash : {1u, 2u, 3u}) settings.push_back(precision(thesis_residual, hash));
  settings.push_back(ours());
  return settings;
}

// Numbers of rays where one setting's value is below another's; both must be measured.
std::string where_less(const std::vector<CacheRow>& rows, const std::string& drive, const std::string& less,
                       const std::string& more, double (*value)(const CacheRow&), double factor = 1) {
  return where_words(rays_of(rows), [&](uint64_t rays) {
    const CacheRow *a = find_cached(rows, less, rays, drive), *b = find_cached(rows, more, rays, drive);
    return a && b && factor * value(*a) < value(*b);
  });
}

double warm_s(const CacheRow& row) { return row.warm.loop_s; }
double l2_m(const CacheRow& row) { return row.error.l2_m; }

LinePlot rays_plot(const std::vector<CacheRow>& rows, const std::vector<LinePanel>& panels) {
  LinePlot plot;
  plot.x = "rays";
  plot.x_label = "rays";
  plot.log_x = true;
  plot.panels_a_row = static_cast<uint32_t>(panels.size());
  plot.panels = panels_of(rows, panels);
  return plot;
}

const std::vector<LinePanel> time_panels = {{"time", "warm_s", "s a frame", "", true},
                                            {"time saved", "saved_percent", "%", ""}};
const std::vector<LinePanel> error_panels = {{"centroid, L2", "l2_m", "m", "", false, 1e-3},
                                             {"lost paths", "lost_share", "share", "", false, 1e-3},
                                             {"lost power", "lost_power", "share", "", true, 1e-7}};

// The same in words for every drive.
std::string where_less(const std::vector<CacheRow>& rows, const std::string& less, const std::string& more,
                       double (*value)(const CacheRow&), double factor = 1) {
  return each_drive(rows, [&](const std::string& drive) { return where_less(rows, drive, less, more, value, factor); });
}

Findings show_times(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "If purged by position, the thesis finds Morton codes 15% faster than the uniform hash from 20,000 rays on, and "
      "the mixed one like the uniform; if purged by precision, Morton codes slower than no cache (section 6.3.2, "
      "figure 6.14). Measured on {}.",
      measured.device.name);
  const std::vector<Verdict> verdicts = {
      {"by position, Morton codes take 15% less time than the uniform hash",
       where_less(rows, position(2).name, position(1).name, warm_s, 1 / 0.85)},
      {"by precision, Morton codes take more time than no cache",
       where_less(rows, no_cache().name, precision(thesis_residual, 2).name, warm_s)}};
  return cache_findings(recipe, measured, request, {paragraph, verdicts}, rays_plot(rows, time_panels),
                        "Average time of a frame by hash function");
}

Findings show_errors(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "By position, the thesis finds the error with Morton codes on average twice that with the uniform hash, and the "
      "mixed one's like the uniform's; by precision, Morton codes the most accurate (section 6.3.2, figure 6.15). Its "
      "lookups do not compare keys, so that collisions of a hash are errors; here they are misses, and a hash decides "
      "only which segments find room. Measured on {}.",
      measured.device.name);
  const std::vector<Verdict> verdicts = {
      {"by position, the centroid is off farther with Morton codes than with the uniform hash",
       where_less(rows, position(1).name, position(2).name, l2_m)},
      {"by position, twice as far off with Morton codes as with the uniform hash",
       where_less(rows, position(1).name, position(2).name, l2_m, 2)},
      {"by precision, less far with Morton codes than with the uniform hash",
       where_less(rows, precision(thesis_residual, 2).name, precision(thesis_residual, 1).name, l2_m)}};
  return cache_findings(recipe, measured, request, {paragraph, verdicts}, rays_plot(rows, error_panels),
                        "Error by hash function");
}

Findings show_ordered_times(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const auto any_saves = [&](uint64_t rays, const std::string& drive) {
    return std::any_of(rows.begin(), rows.end(), [&](const CacheRow& row) {
      return row.rays == rays && row.drive == drive && row.saved_percent >= 0.5 && row.setting != ours().name;
    });
  };
  const std::string paragraph = fmt::format(
      "With rays in order (H3DH), the thesis finds caches to save nothing, but those by precision with the uniform and "
      "the mixed hash up to some 37,000 rays (section 6.3.2, figure 6.16). Measured on {}.",
      measured.device.name);
  const std::vector<Verdict> verdicts = {
      {"one of the caches saves time", each_drive(rows,
                                                  [&](const std::string& drive) {
                                                    return where_words(rays_of(rows), [&](uint64_t rays) {
                                                      return any_saves(rays, drive);
                                                    });
                                                  })},
      {"by precision, the uniform hash is faster than no cache",
       where_less(rows, precision(thesis_residual, 1).name, no_cache().name, warm_s)}};
  return cache_findings(recipe, measured, request, {paragraph, verdicts}, rays_plot(rows, time_panels),
                        "Average time of a frame by hash function, rays in order");
}

Findings show_ordered_errors(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "With rays in order, the thesis finds the error of the caches that save time, those by precision with the "
      "uniform and the mixed hash, to hover around 5 units, more than by position (section 6.3.2, figure 6.17). "
      "Measured on {}.",
      measured.device.name);
  const std::vector<Verdict> verdicts = {
      {"the centroid is off farther by precision than by position, with the uniform hash",
       where_less(rows, position(1).name, precision(thesis_residual, 1).name, l2_m)}};
  return cache_findings(recipe, measured, request, {paragraph, verdicts}, rays_plot(rows, error_panels),
                        "Error by hash function, rays in order");
}

}  // namespace

std::vector<Recipe> hashing_figures() {
  CacheStudy unordered{.name = "hashing",
                       .settings = by_hash(),
                       .rays = {1000, 5000, 10000, 20000, 37000, 49000, 100000, 200000, 490000},
                       .few_rays = {1000, 10000, 49000},
                       .drives = {"fixed", "spheres"}};
  CacheStudy ordered = unordered;
  ordered.name = "hashing-ordered";
  ordered.rays = {1000, 5000, 10000, 20000, 37000, 49000, 61000, 100000, 200000, 610000};
  ordered.few_rays = {1000, 10000, 61000};
  for (Setting& setting : ordered.settings) setting = with_order(setting);
  const auto a = std::make_shared<const CacheStudy>(unordered), b = std::make_shared<const CacheStudy>(ordered);
  return {{.name = "figure-6.14",
           .doc = "traffic: time by hash function",
           .title = "Frames in traffic by hash function",
           .series = {},
           .study = a,
           .view = show_times},
          {.name = "figure-6.15",
           .doc = "traffic: error by hash function",
           .title = "Errors in traffic by hash function",
           .series = {},
           .study = a,
           .view = show_errors},
          {.name = "figure-6.16",
           .doc = "traffic: time by hash function, rays in order",
           .title = "Frames in traffic by hash function, rays in order",
           .series = {},
           .study = b,
           .view = show_ordered_times},
          {.name = "figure-6.17",
           .doc = "traffic: error by hash function, rays in order",
           .title = "Errors in traffic by hash function, rays in order",
           .series = {},
           .study = b,
           .view = show_ordered_errors}};
}

}  // namespace wavetracer::study
