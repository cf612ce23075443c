// One rule a feature; the reason is for people, and names what to change.
// Materials and edges of vehicles count as those of the scene do.
#include "simulation/features.hpp"

#include <algorithm>
#include <numbers>

#include "radio/opacity.hpp"

namespace wavetracer {

namespace {

template <class Holds>
bool any_scene(const Scene& scene, const World& world, const Holds& holds) {
  return holds(scene) || std::ranges::any_of(world.models(), holds);
}

template <class Holds>
bool any_material(const Scene& scene, const World& world, const Holds& holds) {
  return any_scene(scene, world, [&](const Scene& s) {
    return std::ranges::any_of(s.surfaces,
                               [&](const Surface& surface) { return holds(s.materials[surface.material]); });
  });
}

// On unless one of the reasons holds; the first that does is given.
Feature feature(std::initializer_list<std::pair<bool, const char*>> reasons) {
  for (const auto& [holds, reason] : reasons)
    if (holds) return {false, reason};
  return {true, {}};
}

}  // namespace

Features choose_features(const Config& config, const Scene& scene, const World& world) {
  const TraceConfig& trace = config.trace;
  const bool wedges = any_scene(scene, world, [](const Scene& s) { return !s.wedges.empty(); });
  const bool closed = any_scene(scene, world, [](const Scene& s) {
    return std::ranges::any_of(s.wedges, [](const Wedge& w) { return w.exterior_rad < 2 * std::numbers::pi - 1e-6; });
  });
  const bool passable =
      any_material(scene, world, [&](const Material& m) { return !is_opaque(m, config.radio.frequency_hz); });
  const bool rough = any_material(scene, world, [](const Material& m) { return m.scattering > 0; });
  const std::pair<bool, const char*> no_depth{trace.max_depth == 0, "trace.max_depth = 0"};

  Features out;
  out["reflection"] = feature({{!trace.reflection, "trace.reflection = false"}, no_depth});
  out["diffraction"] =
      feature({{!trace.diffraction, "trace.diffraction = false"},
               no_depth,
               {!wedges, "no edge of the scene diffracts"},
               {!trace.free_edges && !closed, "all edges that diffract are free, and trace.free_edges = false"}});
  out["double_diffraction"] = feature({{!out["diffraction"].on, "diffraction is off"},
                                       {trace.max_diffractions < 2, "trace.max_diffractions = 1"},
                                       {trace.max_depth < 2, "trace.max_depth = 1"}});
  out["transmission"] = feature({{!trace.transmission, "trace.transmission = false"},
                                 no_depth,
                                 {!passable, "all materials are metals or half spaces, which nothing passes"}});
  out["scattering"] =
      feature({{!trace.scattering, "trace.scattering = false"},
               no_depth,
               {!rough, "no material of the scene has a scattering coefficient (material.scattering)"}});
  out["instances"] = feature({{world.instances().empty(), "no vehicle has a body"}});
  return out;
}

TraceConfig with_features(TraceConfig trace, const Features& features) {
  trace.reflection = features.at("reflection").on;
  trace.diffraction = features.at("diffraction").on;
  trace.transmission = features.at("transmission").on;
  trace.scattering = features.at("scattering").on;
  if (!features.at("double_diffraction").on) trace.max_diffractions = 1;
  return trace;
}

}  // namespace wavetracer
