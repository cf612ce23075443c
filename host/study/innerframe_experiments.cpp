// SPDX-License-Identifier: Apache-2.0
// Coherence inside a frame: of rays with equal keys one is traced, with cells of directions that the control equation
// gives for a C_E. Every frame finds its table empty, so that it only saves time within itself.
#include <cmath>
#include <memory>
#include <utility>
#include "study/control_equation.hpp"
#include "study/experiment.hpp"
#include "study/innerframe_claims.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

// They contain no commas, since they are cells of tables.
constexpr const char *each = "no groups", *own = "groups with own hit points", *taken = "groups with one hit point";
const std::vector<std::string> grouped_settings = {own, taken};

using Change = std::function<void(CacheConfig&)>;

Setting grouping(const std::string& name, double error, Directions directions, const Change& change) {
  return {name, [=](Config& config) {
            ours().apply(config);
            config.trace.directions = directions;
            config.cache.division = control_division(*config.trace.rays, error);
            config.cache.innerframe = true;
            change(config.cache);
          }};
}

std::vector<Setting> by_error(Directions directions) {
  std::vector<Setting> settings = {
      {"no cache", [directions](Config& config) { config.trace.directions = directions; }}};
  // As in the thesis: moving objects are cached too, and the ray becomes the one that was traced.
  const Change as_thesis = [](CacheConfig& cache) {
    cache.scope = "all";
    cache.hit_point = "cached";
  };
  for (const double error : {0.25, 0.5, 1.0, 2.0, 4.0, 10.0}) {
    settings.push_back(grouping(own, error, directions, [](CacheConfig&) {}));
    settings.push_back(grouping(taken, error, directions, as_thesis));
    settings.push_back(grouping(each, error, directions, [as_thesis](CacheConfig& cache) {
      as_thesis(cache);
      cache.innerframe = false;
    }));
  }
  return settings;
}

std::shared_ptr<const CacheStudy> study_of(const std::string& name, Directions directions) {
  return std::make_shared<const CacheStudy>(CacheStudy{.name = name,
                                                       .settings = by_error(directions),
                                                       .rays = {10000, 50000, 200000, 1000000, 10000000},
                                                       .few_rays = {10000, 50000, 200000},
                                                       .drives = {"fixed"},
                                                       .at_once = 6,
                                                       .most_frames = 20,
                                                       .empty_tables = true});
}

NumberTable groups_table(const std::vector<CacheRow>& rows) {
  NumberTable table{.caption = "Of a frame, against the same rays without a cache:",
                    .heads = {"rays", "C_E", "division", "setting", "segments", "groups", "traced",
                              "answered in the frame", "time", "lost paths", "lost power"},
                    .rows = {}};
  const auto count = [](double value) { return grouped(static_cast<uint64_t>(std::llround(value))); };
  for (const CacheRow& row : rows) {
    if (row.counts.lookups == 0) continue;
    table.rows.push_back({grouped(row.rays), plain(control_error(static_cast<double>(row.rays), row.division), 2),
                          grouped(row.division), row.setting, count(row.counts.segments), count(row.counts.groups),
                          count(row.counts.traced()), count(row.counts.shared), saved_words(row.saved_percent),
                          share_words(row.error.lost_share), share_words(row.error.lost_power)});
  }
  return table;
}

CacheShown groups_of_keys(const CacheMeasurement& measured) {
  return {.plot = {.settings = {own, taken, each},
                   .x = "control_error",
                   .x_label = "C_E: root of the rays a cell of directions",
                   .log_x = true,
                   .only_rays = rays_of(measured.rows).back(),
                   .panels = panels_of(measured.rows, {{"time saved", "saved_percent", "%", ""},
                                                       {"segments traced", "traced_share", "share", "", true, 1e-4},
                                                       {"lost power", "lost_power", "share", "", true, 1e-7},
                                                       {"lost paths", "lost_share", "share", "", true, 1e-5}})},
          .numbers = groups_table(measured.rows),
          .notes = {"every frame finds its table empty; segments \"answered in the frame\" took the hit of the ray "
                    "that was traced for their group, others that are not traced were answered by the table with "
                    "a hit of an earlier depth",
                    "with its own hit point a ray that meets the plane of its group's surface outside of it "
                    "is traced as well; with one hit point it becomes the ray that was traced, as in the thesis; "
                    "without groups every ray that the table does not answer is traced"}};
}

CacheFigure innerframe_figure(const std::string& name, Directions directions) {
  return {
      .study = study_of(name, directions),
      .view = groups_of_keys,
      .claims = {{"of a group of coherent rays only one is traced", one_ray_a_group({taken})},
                 {"tracing takes less time by coherence inside the frame", somewhere_faster(grouped_settings, 1)},
                 {"the same, with at most 1% of the paths lost", somewhere_faster(grouped_settings, 0.01), std::nullopt,
                  Origin::repetition},
                 {"up to 50 times fewer rays are traced (Popov)", fewer_traced_times(50), std::nullopt, Origin::other},
                 {"rendering is 2.5 times as fast at least (Popov)", times_as_fast(2.5), std::nullopt, Origin::other},
                 {"a larger C_E errs more (Popov)", error_grows(grouped_settings), std::nullopt, Origin::other},
                 {"C_E controls the error: at equal C_E, lost paths are within a factor of three whatever "
                  "the number of rays (Popov)",
                  error_is_controlled(grouped_settings, 3, 1e-3), std::nullopt, Origin::other}}};
}

CacheFigure with_repeated_claims(CacheFigure figure) {
  figure.claims = repeated(std::move(figure.claims));
  return figure;
}

constexpr const char* innerframe_paragraph =
    "The thesis expects that of a group of coherent rays inside a frame only one need be traced (sections 1.1 "
    "and 3.2.2), after Popov, who groups paths by quantised ends, controls the error by |A(e)| |A(l)| = C_E^2 / "
    "(P(e) P(l) "
    "N) (equation 2.3), and traces up to 50 times fewer rays and renders 2.5 to 6.7 times as fast (section 2.1); "
    "it measures none of it. For a cell of directions, C_E is the root of the rays that a launch has in it. "
    "Measured on {device} with cache.innerframe";

const std::vector<Experiment> innerframe = {
    {.name = "innerframe",
     .doc = "one ray traced for each group of equal keys: saving against error and time, by the control equation",
     .title = "Coherence inside a frame, by groups of rays",
     .caption = "Saving and error of tracing one ray per group",
     .paragraph = std::string(innerframe_paragraph) + ", rays at random.",
     .figure = innerframe_figure("innerframe", "random")},
    {.name = "innerframe-ordered",
     .doc = "the same with rays in order",
     .title = "Coherence inside a frame, by groups of rays in order",
     .caption = "Saving and error of tracing one ray per group, rays in order",
     .paragraph = std::string(innerframe_paragraph) + ", rays along a Hilbert curve.",
     .figure = with_repeated_claims(innerframe_figure("innerframe-ordered", "hilbert"))},
};

}  // namespace

const std::vector<Experiment>& innerframe_experiments() { return innerframe; }

}  // namespace wavetracer::study
