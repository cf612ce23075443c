// SPDX-License-Identifier: Apache-2.0
// There is one rule for each feature; the reason is a text for the user, and names the key to change. Materials and
// edges of vehicles count like those of the scene.
#include "simulation/feature_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "config/contradictions.hpp"
#include "radio/cells.hpp"
#include "radio/material.hpp"
#include "radio/opacity.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {

namespace {

template <class Holds>
bool any_scene(const Scene& scene, const World& world, const Holds& holds) {
  return holds(scene) || std::ranges::any_of(world.fleet.models, holds);
}

template <class Holds>
bool any_material(const Scene& scene, const World& world, const Holds& holds) {
  return any_scene(scene, world, [&](const Scene& s) {
    return std::ranges::any_of(s.surfaces,
                               [&](const Surface& surface) { return holds(s.materials[surface.material]); });
  });
}

// One text names all of them; later code that needs a material would only name the first.
void check_materials(const Config& config, const Scene& scene, const World& world) {
  std::vector<Material> used;
  any_material(scene, world, [&](const Material& material) {
    if (std::ranges::find(used, material) == used.end()) used.push_back(material);
    return false;
  });
  if (const std::string problem = range_problem(used, config.radio.frequency_hz); !problem.empty())
    throw ConfigError(problem);
}

struct Reason {
  bool holds;
  std::string words;
};

// The feature is on unless one of the reasons holds; the first that holds is given.
Feature feature(const std::vector<Reason>& reasons) {
  const auto found = std::ranges::find_if(reasons, &Reason::holds);
  return found == reasons.end() ? Feature{true, {}} : Feature{false, found->words};
}

// The needs of each kind of interaction, by its code; a kind that is missing here needs nothing.
std::map<Interaction, std::vector<Reason>> needs(const Config& config, const Scene& scene, const World& world) {
  const bool wedges = any_scene(scene, world, [](const Scene& s) { return !s.wedges.empty(); });
  const bool closed = any_scene(scene, world, [](const Scene& s) {
    return std::ranges::any_of(s.wedges, [](const Wedge& w) { return w.exterior_rad < 2 * std::numbers::pi - 1e-6; });
  });
  const bool passable =
      any_material(scene, world, [&](const Material& m) { return !is_opaque(m, config.radio.frequency_hz); });
  const bool rough = any_material(scene, world, [](const Material& m) { return m.scattering > 0; }) || has_cells(scene);
  return {{diffraction,
           {{!wedges, "no edge of the scene diffracts"},
            {!config.trace.free_edges && !closed, "all edges that diffract are free, and trace.free_edges = false"}}},
          {transmission, {{!passable, "all materials are metals or half spaces, and no wave passes through them"}}},
          {scattering, {{!rough, "no material of the scene has a scattering coefficient (material.scattering)"}}},
          {target_point, {{world.targets.empty(), "no vehicle and no place is a target ([[target_model]])"}}}};
}

// Beams, if trace.discovery asks for them or leaves the choice. Reasons are about what is known before any ray is
// launched, so each run of a configuration makes the same choice, on every device.
Feature beams(const Config& config, const Scene& scene, const World& world, bool frames_follow, bool diffracts) {
  TraceConfig trace = config.trace;
  if (trace.by_beams()) return {true, {}};
  trace.diffraction = diffracts;
  const std::string rays = config::needs_rays(config, trace);
  const bool one_frame = world.clock.frame_count() == 1 && !frames_follow;
  return feature({{trace.discovery == "rays", "trace.discovery = \"rays\""},
                  {!rays.empty(), rays},
                  {!world.resting || !world.fleet.instances.empty(), "bodies of vehicles are followed by rays"},
                  {!one_frame, "frames follow each other, and reuse what rays have found"},
                  {trace.transmission, "beams through walls take longer (trace.transmission)"},
                  {trace.scattering, "trace.scattering = true"},
                  {!world.targets.empty(), "there are targets"},
                  {trace.max_depth > auto_beam_depth,
                   fmt::format("trace.max_depth = {} is more than {}", trace.max_depth, auto_beam_depth)},
                  {scene.surfaces.size() > auto_beam_surfaces,
                   fmt::format("{} surfaces are more than {}", scene.surfaces.size(), auto_beam_surfaces)}});
}

}  // namespace

Features choose_features(const Config& config, const Scene& scene, const World& world, bool frames_follow) {
  check_materials(config, scene, world);
  const TraceConfig& trace = config.trace;
  auto needed = needs(config, scene, world);
  Features out;
  for (const InteractionKind& kind : interaction_kinds) {
    std::vector<Reason> reasons{{!(trace.*kind.asked_for), fmt::format("trace.{} = false", kind.word)},
                                {trace.max_depth == 0, "trace.max_depth = 0"}};
    std::ranges::move(needed[kind.code], std::back_inserter(reasons));
    out[std::string(kind.word)] = feature(reasons);
  }
  out["double_diffraction"] = feature({{!out["diffraction"].on, "diffraction is off"},
                                       {trace.max_diffractions < 2, "trace.max_diffractions = 1"},
                                       {trace.max_depth < 2, "trace.max_depth = 1"}});
  out["scattering_reflections"] = feature({{!out["scattering"].on, "scattering is off"},
                                           {trace.scattering_reflections == 0, "trace.scattering_reflections = 0"},
                                           {!out["reflection"].on, "reflection is off"},
                                           {trace.max_depth < 2, "trace.max_depth = 1"}});
  out["scattering_diffraction"] = feature({{!out["scattering_reflections"].on, "paths that scatter are not reflected"},
                                           {!trace.scattering_diffraction, "trace.scattering_diffraction = false"},
                                           {!out["diffraction"].on, "diffraction is off"}});
  out["target_reflections"] = feature({{!out["target"].on, "there are no paths over targets"},
                                       {trace.target_reflections == 0, "trace.target_reflections = 0"},
                                       {!out["reflection"].on, "reflection is off"},
                                       {trace.max_depth < 2, "trace.max_depth = 1"}});
  out["target_diffraction"] = feature({{!out["target_reflections"].on, "paths over targets are not reflected"},
                                       {!trace.target_diffraction, "trace.target_diffraction = false"},
                                       {!out["diffraction"].on, "diffraction is off"}});
  out["instances"] = feature({{world.fleet.instances.empty(), "no vehicle has a body"}});
  out["vegetation"] = feature({{scene.volumes.empty(), "the scene has no volume of vegetation"}});
  const AirConfig& air = config.air;
  out["air"] = feature({{!air.gases && air.fog_g_m3 == 0 && air.rain_mm_h == 0,
                         "air.gases = false, air.fog_g_m3 = 0 and air.rain_mm_h = 0"}});
  out["beams"] = beams(config, scene, world, frames_follow, out["diffraction"].on);
  return out;
}

TraceConfig with_features(TraceConfig trace, const Features& features) {
  for (const InteractionKind& kind : interaction_kinds) trace.*kind.asked_for = features.at(std::string(kind.word)).on;
  if (!features.at("double_diffraction").on) trace.max_diffractions = 1;
  if (!features.at("scattering_reflections").on) trace.scattering_reflections = 0;
  trace.scattering_diffraction = features.at("scattering_diffraction").on;
  if (!features.at("target_reflections").on) trace.target_reflections = 0;
  trace.target_diffraction = features.at("target_diffraction").on;
  trace.discovery = features.at("beams").on ? DiscoveryWay("beams") : DiscoveryWay("rays");
  return trace;
}

}  // namespace wavetracer
