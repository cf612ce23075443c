// SPDX-License-Identifier: Apache-2.0
// Traces one frame for each map of directions, and judges it in launch order: the order in which rays share launches
// and packets. A ray that ended leaves a gap, so a lag counts launched rays at every depth.
#include "study/coherence_rays.hpp"
#include <fmt/format.h>
#include <memory>
#include <numeric>
#include "study/hit_recorder.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"

namespace wavetracer::study {
namespace {

constexpr uint32_t most_lag = 1000;
const std::vector<std::string> maps = {"hilbert", "fibonacci", "random"};

}  // namespace

const Columns<LagRow>& lag_columns() {
  using R = LagRow;
  static const Columns<R> all = {
      {"directions", &R::directions},
      {"depth", &R::depth},
      {"lag", [](const R& r) { return r.found.lag; }},
      {"pairs", [](const R& r) { return r.found.pairs; }},
      {"points", [](const R& r) { return r.found.points; }},
      {"distance", [](const R& r) { return r.found.distance; }},
      {"same_surface", [](const R& r) { return r.found.same_surface; }},
      {"same_primitive", [](const R& r) { return r.found.same_primitive; }},
  };
  return all;
}

Findings measure(const LagFigure&, const Experiment& experiment, const Request& request, const Host& host) {
  std::shared_ptr<void> guard = host.guard();  // a map of directions alone is no result
  TracedWorld traced(request.config, request.device);
  const Drive drive =
      plan_drive(traced, 1, 1, request.config.file.empty() ? "" : request.config.file + ": " + experiment.name + ": ");
  host.say(fmt::format("{}: a frame of {} rays for each of {} on {}", experiment.name, grouped(experiment_rays),
                       fmt::join(maps, ", "), traced.device.name));
  Findings found{.device = traced.device, .planned = 1};
  std::vector<uint32_t> lags(most_lag);
  std::iota(lags.begin(), lags.end(), 1);
  std::vector<LagRow> rows;
  for (const std::string& directions : maps) {
    if (host.interrupted()) return found;
    TraceConfig trace = request.config.trace;
    trace.rays = experiment_rays;
    trace.directions = Directions::named(directions);
    const FrameHits hits = HitRecorder(traced, trace)(drive.transmitter, drive.first);
    for (uint32_t i = 0; i < hits.size(); ++i)
      for (const LagCoherence& at : coherence_along(hits[i], lags))
        rows.push_back({.directions = directions, .depth = i + 1, .found = at});
  }
  guard.reset();
  found.points = 1;
  DepthPlot plot{.name = experiment.name,
                 .title = experiment.title + ", " + traced.device.name,
                 .max_depth = request.config.trace.max_depth,
                 .x_label = "lag (rays)",
                 .log_x = true,
                 .points = true,
                 .panels_a_row = 3,
                 .panels = {}};
  for (const std::string& directions : maps)
    plot.panels.push_back({directions + ": autocorrelation of points", "lag", "points", "directions", directions});
  for (const std::string& directions : maps)
    plot.panels.push_back({directions + ": same surface", "lag", "same_surface", "directions", directions});
  found.figure = depth_figure(plot, csv_of(lag_columns(), rows));
  found.words = lag_words(experiment, rows, traced.device.name);
  found.notes = {
      fmt::format("rays: {} of the transmitter \"{}\", a frame for each map of directions", grouped(experiment_rays),
                  drive.name),
      "points and distance are equation 3.4 over the squares of what is paired, of hit points as vectors "
      "and of segment lengths; same_surface and same_primitive are shares of the pairs; a pair is two rays that hit"};
  return found;
}

}  // namespace wavetracer::study
