// SPDX-License-Identifier: Apache-2.0
#include "config/edge_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>

namespace wavetracer::config {
namespace {

// A key that rays from edges do not go with, its value, and what a user may do instead.
struct Obstacle {
  const char* key;
  std::string value;
  const char* instead;
};

// Listeners know only the edges that transmitters see and the surfaces that rays reflect from, so paths over two edges,
// through walls and by tiles that only receivers see would be lost.
std::vector<Obstacle> obstacles(const Config& config, const TraceConfig& trace) {
  std::vector<Obstacle> out;
  if (trace.max_diffractions > 1)
    out.push_back({"trace.max_diffractions", std::to_string(trace.max_diffractions), "allow one diffraction"});
  if (trace.transmission) out.push_back({"trace.transmission", "true", "set that to false"});
  if (trace.reflects_scattered())
    out.push_back({"trace.scattering_reflections", std::to_string(trace.scattering_reflections), "set that to 0"});
  if (trace.by_beams()) out.push_back({"trace.discovery", "\"beams\"", "use \"rays\""});
  if (config.cache.on()) out.push_back({"cache.kind", fmt::format("\"{}\"", config.cache.kind.text()), "use \"none\""});
  return out;
}

}  // namespace

uint64_t listener_count(const Config& config) {
  std::unordered_set<std::string_view> senders;
  for (const RadioEnd& end : config.transmitters) senders.insert(end.name);
  return static_cast<uint64_t>(
      std::ranges::count_if(config.receivers, [&](const RadioEnd& end) { return !senders.contains(end.name); }));
}

void check_edge_rays(const Config& config, std::vector<Contradiction>& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.diffraction || trace.edge_rays.value_or(0) == 0) return;
  for (const Obstacle& obstacle : obstacles(config, trace))
    out.push_back({{"trace.edge_rays", obstacle.key},
                   fmt::format("trace.edge_rays = {} does not go with {} = {}: give trace.edge_rays = 0, so that "
                               "receivers launch rays, or {}",
                               *trace.edge_rays, obstacle.key, obstacle.value, obstacle.instead)});
}

uint64_t edge_rays_of(const Config& config, const TraceConfig& trace) {
  if (!trace.diffraction) return 0;
  if (trace.edge_rays) return *trace.edge_rays;
  if (trace.by_spheres() || trace.diffraction_rays) return 0;
  const bool many = listener_count(config) > many_listeners;
  return many && !trace.reflects_echoes() && obstacles(config, trace).empty() ? automatic_edge_rays : 0;
}

}  // namespace wavetracer::config
