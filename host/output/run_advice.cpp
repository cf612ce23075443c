// SPDX-License-Identifier: Apache-2.0
// There are two rules: without line of sight, most of the power may come around edges; and where thousands of receivers
// search for edges themselves, rays from the edges are fewer.
#include "output/run_advice.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include "base/digits.hpp"

namespace wavetracer {
namespace {

// The wording of choose_features(). It does not say whether the scene has edges: only diffraction looks for them.
constexpr const char* diffraction_off = "trace.diffraction = false";

// The warning about links without a path names the same key.
bool said(const std::vector<std::string>& warnings) {
  return std::ranges::any_of(
      warnings, [](const std::string& text) { return text.find("trace.diffraction") != std::string::npos; });
}

// With so many rays of each edge the map of docs/scenarios.md misses 6.5 10^-4 of its power, and takes .9 of the time
// of 1000.
constexpr int map_edge_rays = 500;

// Cells that launch rays cost more than the edges of a whole city would: 2 km x 2 km launch 31 million with
// map_edge_rays.
constexpr uint64_t many_rays = 100'000'000;

bool is_map(const Run& run, const Totals& totals) { return !run.config.receiver_grids.empty() && totals.frames == 1; }

std::optional<std::string> edges_left_out(const Run& run, const Totals& totals) {
  const auto found = run.summary.features.find("diffraction");
  const bool left_out = found != run.summary.features.end() && found->second.reason == diffraction_off;
  const uint64_t sight = totals.kinds[0];  // at most one per link
  if (!left_out || totals.counts.paths == 0 || 2 * sight >= totals.links) return {};
  if (said(run.summary.warnings) || said(totals.warnings)) return {};
  const std::string for_map =
      is_map(run, totals)
          ? fmt::format(", with trace.edge_rays = {} for this map (else each of its {} receivers launches rays)",
                        map_edge_rays, grouped(run.config.receivers.size()))
          : "";
  return fmt::format(
      "line of sight on {} of {} links, and trace.diffraction = false leaves out all that comes around edges: "
      "set it to true{}, or ask `wavetracer accuracy -c FILE` what it would add",
      grouped(sight), grouped(totals.links), for_map);
}

// Could the run have rays from edges? It could not with what check_edge_rays of host/config refuses, nor where
// something moves.
bool may_launch_from_edges(const Config& config) {
  const TraceConfig& trace = config.trace;
  return trace.max_diffractions <= 1 && !trace.transmission && !trace.reflects_scattered() &&
         !trace.reflects_echoes() && !trace.by_beams() && !config.cache.on() && config.trajectories.file.empty() &&
         config.mounts.empty();
}

std::optional<std::string> cells_launch(const Run& run, const Totals& totals) {
  const TraceConfig& trace = run.config.trace;
  if (!is_map(run, totals) || !trace.diffraction || trace.edge_rays > 0 || !trace.rays) return {};
  if (!may_launch_from_edges(run.config)) return {};
  const uint64_t of_transmitters = *trace.rays * run.config.transmitters.size();
  if (totals.counts.rays < of_transmitters + many_rays) return {};
  return fmt::format(
      "the {} receivers launched {} rays to find the edges that they see: trace.edge_rays = {} starts rays at the "
      "edges that transmitters see instead, and their number does not grow with that of receivers",
      grouped(run.config.receivers.size()), grouped(totals.counts.rays - of_transmitters), map_edge_rays);
}

}  // namespace

std::vector<std::string> advice(const Run& run, const Totals& totals) {
  std::vector<std::string> out;
  for (auto& text : {edges_left_out(run, totals), cells_launch(run, totals)})
    if (text) out.push_back(*text);
  return out;
}

}  // namespace wavetracer
