// SPDX-License-Identifier: Apache-2.0
// Keys of [trace] that count only together with another one. Keys that ask for paths, or that leave some out, are
// refused without it. Keys that say how a feature is computed may stay where it is switched off; a run names them.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "config/contradictions.hpp"

namespace wavetracer::config {
namespace {

// A key, whether it has a value of its own, its value, and what it needs.
struct Companion {
  const char* key;
  bool given;
  std::string value;
  bool counts;                      // is there what it needs?
  std::vector<const char*> needed;  // keys
  const char* need;                 // in words
};

std::string text_of(const std::optional<double>& value) { return fmt::format("{:g}", value.value_or(0)); }

// Without them the configuration would have other paths than it seems to ask for.
std::vector<Companion> askers(const Config& config) {
  const TraceConfig& t = config.trace;
  return {
      {"trace.diffraction_floor_db",
       t.diffraction_floor_db.has_value(),
       text_of(t.diffraction_floor_db),
       t.diffraction,
       {"trace.diffraction"},
       "trace.diffraction = true"},
      {"trace.edge_ends", t.edge_ends, "true", t.diffraction, {"trace.diffraction"}, "trace.diffraction = true"},
      {"trace.scattering_reflections",
       t.scattering_reflections > 0,
       std::to_string(t.scattering_reflections),
       t.scattering,
       {"trace.scattering"},
       "trace.scattering = true"},
      {"trace.scattering_floor_db",
       t.scattering_floor_db.has_value(),
       text_of(t.scattering_floor_db),
       t.reflects_scattered(),
       {"trace.scattering", "trace.scattering_reflections"},
       "trace.scattering = true and trace.scattering_reflections of at least 1"},
      {"trace.target_reflections",
       t.target_reflections > 0,
       std::to_string(t.target_reflections),
       has_targets(config),
       {},
       "a [[target]], or a [[target_model]] with on"},
      {"trace.target_floor_db",
       t.target_floor_db.has_value(),
       text_of(t.target_floor_db),
       has_targets(config),
       {},
       "a [[target]], or a [[target_model]] with on"},
      {"trace.target_diffraction",
       t.target_diffraction,
       "true",
       has_targets(config),
       {},
       "a [[target]], or a [[target_model]] with on"},
  };
}

std::vector<Companion> settings(const Config& config) {
  const TraceConfig& t = config.trace;
  const TraceConfig usual;
  const auto differs = [&](auto member) { return t.*member != usual.*member; };
  const std::vector<const char*> edges{"trace.diffraction"}, none;
  const char* const of_edges = "trace.diffraction = true";
  std::vector<Companion> out{
      {"trace.max_diffractions", differs(&TraceConfig::max_diffractions), std::to_string(t.max_diffractions),
       t.diffraction, edges, of_edges},
      {"trace.free_edges", differs(&TraceConfig::free_edges), "false", t.diffraction, edges, of_edges},
      {"trace.edge_rays", t.edge_rays.value_or(0) > 0, std::to_string(t.edge_rays.value_or(0)), t.diffraction, edges,
       of_edges},
      {"trace.diffraction_rays", t.diffraction_rays.has_value(), std::to_string(t.diffraction_rays.value_or(0)),
       t.from_both_ends(), none,
       "trace.diffraction = true, trace.scattering_reflections or trace.target_reflections of at least 1"},
      {"trace.max_transmissions", differs(&TraceConfig::max_transmissions), std::to_string(t.max_transmissions),
       t.transmission, none, "trace.transmission = true"},
      {"trace.tile_m", differs(&TraceConfig::tile_m), fmt::format("{:g}", t.tile_m), t.scattering, none,
       "trace.scattering = true"},
      {"trace.recall", differs(&TraceConfig::recall), fmt::format("{:g}", t.recall), !t.rays, none,
       "trace.rays = \"auto\""},
      {"trace.max_rays", differs(&TraceConfig::max_rays), std::to_string(t.max_rays), !t.rays, none,
       "trace.rays = \"auto\""},
      {"trace.refresh_rays", t.refresh_rays.has_value(), std::to_string(t.refresh_rays.value_or(0)), t.reuse, none,
       "trace.reuse = true"},
      {"trace.forget_frames", differs(&TraceConfig::forget_frames), std::to_string(t.forget_frames), t.reuse, none,
       "trace.reuse = true"},
      {"trace.sphere_radius_m", differs(&TraceConfig::sphere_radius_m), fmt::format("{:g}", t.sphere_radius_m),
       t.by_spheres(), none, "trace.reception = \"sphere\""},
  };
  const bool aims = t.target && has_targets(config);
  for (const Companion& asker : askers(config))
    if (asker.given && asker.counts && !aims && std::string_view(asker.key).starts_with("trace.target_"))
      out.push_back({asker.key, true, asker.value, false, none, "trace.target = true"});
  return out;
}

}  // namespace

void check_companions(const Config& config, std::vector<Contradiction>& out) {
  for (const Companion& key : askers(config)) {
    if (!key.given || key.counts) continue;
    std::vector<std::string> keys{key.key};
    keys.insert(keys.end(), key.needed.begin(), key.needed.end());
    out.push_back({std::move(keys), fmt::format("{} = {} has no effect without {}: remove it, or add that", key.key,
                                                key.value, key.need)});
  }
}

std::vector<std::string> idle_settings(const Config& config) {
  std::vector<std::string> out;
  for (const Companion& key : settings(config))
    if (key.given && !key.counts)
      out.push_back(fmt::format("{} = {} has no effect without {}", key.key, key.value, key.need));
  return out;
}

}  // namespace wavetracer::config
