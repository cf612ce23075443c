// SPDX-License-Identifier: Apache-2.0
// Lists the axes, cheapest setting first.
// Keys are those of the field table (host/config/field_table.cpp), which checks them when a setting is read.
#include "accuracy/axes.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <set>

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

// Beams take the place of the reference of rays. Then all other settings of the axis must ask for rays.
void certify_axis(Axis& axis) {
  axis.reference = {"rays", "beams", {"trace.discovery=beams"}};
  for (Setting& setting : axis.settings) setting.keys.push_back("trace.discovery=rays");
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

// Begins at a few hundred, which maps of many receivers can afford. There is no axis with trace.rays = "auto", which
// does not use this number.
std::optional<Axis> listener_axis(const Config& own) {
  if (!own.trace.diffraction || !own.trace.rays) return std::nullopt;
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

std::vector<Axis> axes(const Config& own, bool drive, study::RayRange rays, bool certify) {
  std::vector<Axis> all = {ray_axis(own, drive, rays), depth_axis(own)};
  if (certify || own.trace.by_beams()) certify_axis(all.front());
  if (const auto listeners = listener_axis(own)) all.push_back(*listeners);
  for (const Mechanism& mechanism : mechanisms())
    all.push_back(
        {{mechanism.feature, "on", mechanism.on, mechanism.feature}, {{mechanism.feature, "off", mechanism.off}}});
  return all;
}

}  // namespace wavetracer::accuracy
