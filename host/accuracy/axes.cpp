// SPDX-License-Identifier: Apache-2.0
// Lists the axes, cheapest setting first.
// Keys are those of the field table (host/config/field_table.cpp), which checks them when a setting is read.
#include "accuracy/axes.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <set>
#include "config/contradictions.hpp"
#include "config/edge_rays.hpp"

namespace wavetracer::accuracy {
namespace {

Setting of_rays(uint64_t rays) { return {"rays", grouped(rays), {fmt::format("trace.rays={}", rays)}}; }

Setting of_recall(double recall) {
  return {"auto", fmt::format("recall {:g}", recall), {"trace.rays=auto", fmt::format("trace.recall={:g}", recall)}};
}

Setting of_depth(uint32_t depth) {
  return {"depth", std::to_string(depth), {fmt::format("trace.max_depth={}", depth)}};
}

// Returns every power of ten of the range and three times each, the ends of the range, and the user's own number.
std::set<uint64_t> ray_steps(std::optional<uint64_t> own, study::RayRange range) {
  std::set<uint64_t> steps = {range.first, range.last};
  for (uint64_t decade = 1000; decade <= range.last; decade *= 10)
    for (const uint64_t rays : {decade, 3 * decade})
      if (range.first <= rays && rays <= range.last) steps.insert(rays);
  if (own) steps.insert(*own);
  return steps;
}

// Settings of numbers of rays need rays.
void ask_for_rays(std::vector<Setting>& settings) {
  for (Setting& setting : settings) setting.keys.push_back("trace.discovery=rays");
}

// Beams take the place of the reference of rays.
void certify_axis(Axis& axis) {
  axis.reference = {"rays", "beams", {"trace.discovery=beams"}};
  ask_for_rays(axis.settings);
}

Axis ray_axis(const Config& own, bool drive, study::RayRange range) {
  const std::set<uint64_t> steps = ray_steps(own.trace.rays, range);
  Axis axis{of_rays(10 * *steps.rbegin()), {}};
  for (const uint64_t rays : steps) axis.settings.push_back(of_rays(rays));
  std::set<double> recalls = {0.9, 0.99, 0.999};
  if (!own.trace.rays) recalls.insert(own.trace.recall);
  for (const double recall : recalls) axis.settings.push_back(of_recall(recall));
  if (drive) {
    axis.settings.push_back({"reuse", "on", {"trace.reuse=true"}, {}, true});
    axis.settings.push_back({"reuse", "off", {"trace.reuse=false"}});
  }
  return axis;
}

Axis depth_axis(const Config& own) {
  Axis axis{of_depth(own.trace.max_depth + 1), {}};
  for (uint32_t depth = 0; depth <= own.trace.max_depth; ++depth) axis.settings.push_back(of_depth(depth));
  return axis;
}

Setting of_listener_rays(uint64_t rays) {
  return {"diffraction_rays", grouped(rays), {fmt::format("trace.diffraction_rays={}", rays)}};
}

constexpr uint64_t most_edge_rays = 65536;  // the most that trace.edge_rays may be

Setting of_edge_rays(uint64_t rays) { return {"edge_rays", grouped(rays), {fmt::format("trace.edge_rays={}", rays)}}; }

// In place of the next one, where receivers launch no rays.
std::optional<Axis> edge_axis(const Config& own) {
  if (!own.trace.from_edges()) return std::nullopt;
  std::set<uint64_t> steps = {100, 300, 1000, 3000};
  steps.insert(*own.trace.edge_rays);
  Axis axis{of_edge_rays(std::min<uint64_t>(3 * *steps.rbegin(), most_edge_rays)), {}};
  for (const uint64_t rays : steps) axis.settings.push_back(of_edge_rays(rays));
  return axis;
}

// May rays start at edges, in the frames of these settings or of others that are compared with them?
bool may_start_at_edges(const Config& own) {
  if (own.trace.edge_rays) return *own.trace.edge_rays > 0;
  return !own.receiver_grids.empty() || own.receivers.size() > config::many_listeners;
}

// Does a setting need rays of receivers in place of those of edges? See check_edge_rays in host/config.
bool needs_receivers(const Setting& setting) {
  return std::ranges::any_of(setting.keys, [](const std::string& key) {
    return key == "trace.max_diffractions=2" || key == "trace.transmission=true" || key == "trace.discovery=beams";
  });
}

// Settings that rays of edges do not go with have none, and so do those that they are compared with in mechanisms.
void without_edge_rays(Axis& axis, bool all) {
  std::vector<Setting*> settings{&axis.reference};
  for (Setting& setting : axis.settings) settings.push_back(&setting);
  const bool any = std::ranges::any_of(settings, [](const Setting* setting) { return needs_receivers(*setting); });
  for (Setting* setting : settings)
    if (needs_receivers(*setting) || (all && any)) setting->keys.push_back("trace.edge_rays=0");
}

// Begins at a few hundred, which maps of many receivers can afford. There is no axis with trace.rays = "auto", which
// does not use this number.
std::optional<Axis> listener_axis(const Config& own) {
  if (!own.trace.diffraction || !own.trace.rays || own.trace.from_edges() || own.trace.by_beams()) return std::nullopt;
  std::set<uint64_t> steps;
  for (const uint64_t rays : {300, 1000, 3000, 10000, 30000})
    if (rays <= *own.trace.rays) steps.insert(rays);
  if (own.trace.diffraction_rays) steps.insert(*own.trace.diffraction_rays);
  if (steps.empty()) return std::nullopt;
  const uint64_t most = 3 * *steps.rbegin();
  Axis axis{of_listener_rays(most), {}};
  if (most > *own.trace.rays)
    axis.reference.keys.push_back(fmt::format("trace.rays={}", most));  // the largest number that is used
  for (const uint64_t rays : steps) axis.settings.push_back(of_listener_rays(rays));
  return axis;
}

}  // namespace

const std::vector<Mechanism>& mechanisms() {
  static const std::vector<Mechanism> all = {
      {"diffraction", "Diffraction", {"trace.diffraction=true"}, {"trace.diffraction=false"}},
      {"double_diffraction",
       "Diffraction at a second edge",
       {"trace.diffraction=true", "trace.max_diffractions=2"},
       {"trace.diffraction=true", "trace.max_diffractions=1"}},
      {"transmission", "Transmission through walls", {"trace.transmission=true"}, {"trace.transmission=false"}},
      {"scattering", "Scattering off rough surfaces", {"trace.scattering=true"}, {"trace.scattering=false"}}};
  return all;
}

bool beams_are_cheap(const Config& config) {
  constexpr uint32_t few_reflections = 6;
  const TraceConfig& trace = config.trace;
  const bool reflections_alone = !trace.diffraction && !trace.transmission && !trace.scattering;
  return reflections_alone && trace.max_depth <= few_reflections && config::needs_rays(config, config.trace).empty();
}

std::vector<Axis> axes(const Config& own, bool drive, study::RayRange rays, bool certify) {
  std::vector<Axis> all = {ray_axis(own, drive, rays), depth_axis(own)};
  if (certify || own.trace.by_beams()) {
    certify_axis(all.front());
  } else if (own.trace.discovery == "auto") {
    all.front().reference.keys.push_back("trace.discovery=rays");
    ask_for_rays(all.front().settings);
  }
  if (const auto listeners = listener_axis(own)) all.push_back(*listeners);
  if (const auto edges = edge_axis(own)) all.push_back(*edges);
  const size_t mechanisms_from = all.size();
  for (const Mechanism& mechanism : mechanisms())
    all.push_back(
        {{mechanism.feature, "on", mechanism.on, mechanism.feature}, {{mechanism.feature, "off", mechanism.off}}});
  // All settings of an axis find paths in one way, as those that rays are missing from would say nothing else.
  for (size_t i = 1; own.trace.discovery == "auto" && i < all.size(); ++i) {
    ask_for_rays(all[i].settings);
    all[i].reference.keys.push_back("trace.discovery=rays");
  }
  for (size_t i = 0; may_start_at_edges(own) && i < all.size(); ++i) without_edge_rays(all[i], i >= mechanisms_from);
  return all;
}

}  // namespace wavetracer::accuracy
