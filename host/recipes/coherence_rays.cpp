// One frame for each map of directions, judged in launch order: the order in which rays share launches and packets.
// A ray that ended leaves a gap, so a lag counts launched rays at every depth.
#include "recipes/coherence_rays.hpp"
#include <fmt/format.h>
#include <numeric>
#include "recipes/depth_plot.hpp"
#include "recipes/hit_recorder.hpp"
#include "recipes/ray_counts.hpp"
#include "recipes/run.hpp"

namespace wavetracer::recipes {
namespace {

const std::vector<std::string> columns = {"directions", "depth",    "lag",          "pairs",
                                          "points",     "distance", "same_surface", "same_primitive"};
constexpr uint32_t most_lag = 1000;
const std::vector<std::string> maps = {"hilbert", "fibonacci", "random"};

Findings run(const Recipe& recipe, const Request& request, const Host& host) {
  const auto& place = request.config.transmitters.front().position_m;
  const glm::dvec3 transmitter_m{place[0], place[1], place[2]};
  TracedScene traced(request.config, request.device, {transmitter_m});
  host.say(fmt::format("{}: a frame of {} rays for each of {} on {}", recipe.name, grouped(experiment_rays),
                       fmt::join(maps, ", "), traced.device.name));
  Findings found;
  found.device = traced.device;
  found.planned = 1;
  std::vector<uint32_t> lags(most_lag);
  std::iota(lags.begin(), lags.end(), 1);
  std::vector<LagRow> rows;
  for (const std::string& directions : maps) {
    if (host.interrupted()) return found;
    TraceConfig trace = request.config.trace;
    trace.rays = experiment_rays;
    trace.directions = Directions::named(directions);
    const report::FrameHits hits = HitRecorder(traced, trace)(transmitter_m);
    for (uint32_t i = 0; i < hits.size(); ++i)
      for (const report::LagCoherence& at : report::coherence_along(hits[i], lags))
        rows.push_back({.directions = directions, .depth = i + 1, .found = at});
  }
  found.points = 1;
  found.table = encode_lags(rows);
  DepthPlot plot{.name = recipe.name,
                 .title = recipe.title + ", " + traced.device.name,
                 .columns = columns,
                 .max_depth = request.config.trace.max_depth,
                 .x_label = "lag (rays)",
                 .y_label = "",
                 .log_x = true,
                 .points = true,
                 .panels_a_row = 3,
                 .panels = {}};
  for (const std::string& directions : maps)
    plot.panels.push_back({directions + ": autocorrelation of points", "lag", "points", "directions", directions});
  for (const std::string& directions : maps)
    plot.panels.push_back({directions + ": same surface", "lag", "same_surface", "directions", directions});
  found.script = depth_plot_script(plot);
  found.words = lags_words(rows, traced.device.name);
  found.caption = "Autocorrelation and common surfaces along the launch order";
  found.notes = {
      fmt::format("rays: {} of the transmitter \"{}\", a frame for each map of directions", grouped(experiment_rays),
                  request.config.transmitters.front().name),
      "points and distance are equation 3.4 over the squares of what is paired, of hit points as vectors and of "
      "segment lengths; same_surface and same_primitive are shares of the pairs; a pair is two rays that hit"};
  return found;
}

}  // namespace

std::string encode_lags(const std::vector<LagRow>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const LagRow& row : rows) {
    const report::LagCoherence& f = row.found;
    text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.directions, row.depth, f.lag, f.pairs,
                        f.points, f.distance, f.same_surface, f.same_primitive);
  }
  return text;
}

Recipe coherence_rays() {
  return {.name = "coherence-rays",
          .doc = "autocorrelation of what rays hit along the launch order of one frame, for each map of directions",
          .title = "Coherence inside a frame",
          .series = {},
          .experiment = run};
}

}  // namespace wavetracer::recipes
