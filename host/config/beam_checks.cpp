// SPDX-License-Identifier: Apache-2.0
// Rays and beams: what needs the rays of every frame, and so goes neither with frames that spare them nor with beams.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "config/contradictions.hpp"
#include "config/edge_rays.hpp"

namespace wavetracer::config {
namespace {

// A feature that needs the rays of every frame: its key, and what it does with them.
struct RayTaker {
  const char* key;
  std::string does;
};

std::vector<RayTaker> takers_of_rays(const Config& config) {
  std::vector<RayTaker> out;
  if (config.trace.by_spheres())
    out.push_back({"trace.reception", "trace.reception = \"sphere\" takes its paths from the rays of the frame"});
  if (config.cache.on())
    out.push_back(
        {"cache.kind", fmt::format("cache.kind = \"{}\" answers rays of every frame", config.cache.kind.word())});
  if (config.output.waypoints > 0)
    out.push_back(
        {"output.waypoints", fmt::format("output.waypoints = {} writes rays of every frame", config.output.waypoints)});
  return out;
}

// Beams find sequences without rays, so nothing can be taken from rays.
std::vector<RayTaker> refused_by_beams(const Config& config) {
  std::vector<RayTaker> out = takers_of_rays(config);
  if (const double s = config.trace.discover_every_s; s > 0)
    out.push_back({"trace.discover_every_s", fmt::format("trace.discover_every_s = {} spares frames their rays", s)});
  return out;
}

}  // namespace

// Frames without rays only have the sequences of earlier frames.
void check_discoveries(const Config& config, std::vector<Contradiction>& out) {
  const TraceConfig& trace = config.trace;
  if (!(trace.discover_every_s > 0)) return;
  const std::string given = fmt::format("trace.discover_every_s = {} spares frames their rays", trace.discover_every_s);
  const auto refuse = [&](const char* key, const std::string& why) {
    out.push_back({{"trace.discover_every_s", key},
                   fmt::format("{}, but {}: remove trace.discover_every_s, or {}", given, why,
                               std::string_view(key) == "trace.reuse" ? "set trace.reuse = true"
                                                                      : fmt::format("remove {}", key))});
  };
  if (!trace.reuse) refuse("trace.reuse", "with trace.reuse = false a frame knows only what its own rays find");
  for (const RayTaker& taker : takers_of_rays(config)) refuse(taker.key, taker.does);
}

void check_beams(const Config& config, std::vector<Contradiction>& out) {
  if (!config.trace.by_beams()) return;
  for (const RayTaker& taker : refused_by_beams(config))
    out.push_back({{"trace.discovery", taker.key},
                   fmt::format("trace.discovery = \"beams\" launches no rays, but {}: "
                               "remove {}, or use trace.discovery = \"rays\"",
                               taker.does, taker.key)});
}

// The floor bounds paths that mirrors alone make: an edge or a rough surface sends waves elsewhere.
void check_floor(const Config& config, std::vector<Contradiction>& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.floor_db) return;
  const auto refuse = [&](const char* key, const std::string& why) {
    out.push_back({{"trace.floor_db", key}, fmt::format("trace.floor_db = {} {}", *trace.floor_db, why)});
  };
  if (!trace.by_beams())
    refuse("trace.discovery",
           "leaves out beams that are too weak, but rays are not left out: remove trace.floor_db, or use "
           "trace.discovery = \"beams\"");
  const char* const nothing = "says nothing of the power of waves that {}: remove trace.floor_db, or use {} = false";
  for (const auto& [key, is_on, waves] : {std::tuple{"trace.diffraction", trace.diffraction, "an edge diffracts"},
                                          std::tuple{"trace.scattering", trace.scattering, "a surface scatters"}})
    if (is_on) refuse(key, fmt::format(fmt::runtime(nothing), waves, key));
}

std::string needs_rays(const Config& config, const TraceConfig& trace) {
  const std::vector<RayTaker> takers = refused_by_beams(config);
  if (!takers.empty()) return takers.front().does;
  const uint64_t edge_rays = edge_rays_of(config, trace);
  if (edge_rays == 0) return "";
  return trace.edge_rays
             ? fmt::format("trace.edge_rays = {} launches rays from edges", edge_rays)
             : fmt::format("more than {} receivers listen, so rays start at edges (trace.edge_rays)", many_listeners);
}

}  // namespace wavetracer::config
