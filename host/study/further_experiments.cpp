// SPDX-License-Identifier: Apache-2.0
// Experiments beyond the thesis' figures: coherence inside a frame, and the trade-off of the two quantisations of a
// cache. cache-division and cache-step launch rays along a Hilbert curve, so that the frame without a cache is as fast
// as possible without a sort.
#include <fmt/format.h>
#include <utility>
#include "study/experiment.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

// Returns the same setting with room for all segments, along a Hilbert curve, with one key changed.
Setting varied(const std::string& name, const Setting& base, const std::function<void(CacheConfig&)>& change) {
  return {name, [apply = base.apply, change](Config& config) {
            apply(config);
            config.trace.directions = "hilbert";
            config.cache.buffer_size = ample_buffer(config);
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
constexpr const char* caption = "Speed against error of the quantisation";

const std::vector<Experiment> further = {
    {.name = "coherence-rays",
     .doc = "autocorrelation of what rays hit along the launch order of one frame, for each map of directions",
     .title = "Coherence inside a frame",
     .caption = "Autocorrelation and common surfaces along the launch order",
     .paragraph = "The thesis takes the autocorrelation of results along the rays of a frame (equation 3.4) "
                  "for the measure of coherence inside it, expects that of a group of coherent rays only one need "
                  "be traced (section 3.2.2), and gives no values. Measured on {device} with {rays} rays. "
                  "Fibonacci rays have their neighbours elsewhere: first hits correlate most, by {fibonacci}. "
                  "Tracing one ray for each two in hilbert order gives the other the wrong surface in the share of "
                  "the last row.",
     .figure = LagFigure{}},
    {.name = "cache-division",
     .doc = "speed, hits and error of caches against the cells of their directions",
     .title = "Cells of directions",
     .caption = caption,
     .paragraph = "The thesis chooses 200,000 and 10,000 cells a direction component and gives no reason. "
                  "Measured on {device}, against rays along a Hilbert curve without a cache.",
     .figure = CacheFigure{.study = by_division,
                           .view = trade("division", "division (cells a direction component)", "division",
                                         [](const CacheRow& row) { return grouped(row.division); })}},
    {.name = "cache-step",
     .doc = "speed, hits and error of caches against the step of a moving transmitter's position key",
     .title = "Steps of the transmitter's position key",
     .caption = caption,
     .paragraph = "The thesis quantises the transmitter's position and does not say how finely (section 3.2.3). "
                  "Measured on {device}, against rays along a Hilbert curve without a cache.",
     .figure =
         CacheFigure{.study = by_step,
                     .view = trade("position_step_m", "step of the transmitter's position key (m)", "step",
                                   [](const CacheRow& row) { return fmt::format("{:g} m", row.position_step_m); })}},
};

}  // namespace

const std::vector<Experiment>& further_experiments() { return further; }

}  // namespace wavetracer::study
