// SPDX-License-Identifier: Apache-2.0
// The arithmetic is that of kernels/vehicles/place.cl and wedges.cl, which gives the same bits.
#include "radio/world_records.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "wavetracer/device/vector.h"

namespace wavetracer {
namespace {

void store(double (&to)[3], const glm::dvec3& from) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

wt_wedge record_of(const Wedge& wedge, uint32_t first_surface, uint32_t instance) {
  wt_wedge record{};
  store(record.start, wedge.start);
  store(record.along, wedge.along);
  store(record.face, wedge.face);
  store(record.normal, wedge.normal);
  record.length = wedge.length_m;
  record.exterior = wedge.exterior_rad;
  record.cosine = std::cos(wedge.exterior_rad);
  record.sine = std::sin(wedge.exterior_rad);
  for (int face = 0; face < 2; ++face) {
    record.surfaces[face] = first_surface + wedge.surface[face];
    record.planes[face] = first_surface + wedge.plane[face];
  }
  record.instance = instance;
  record.free_ends = wedge.free_ends;
  return record;
}

}  // namespace

std::vector<wt_exact_surface> surface_records(const Scene& scene, std::span<const Scene> models,
                                              std::span<const Instance> instances, const WorldState& state) {
  std::vector<wt_exact_surface> records;
  for (const Surface& surface : scene.surfaces) {
    wt_exact_surface& record = records.emplace_back();
    store(record.normal, surface.normal);
    record.offset = surface.offset_m;
    record.instance = WT_NONE;
  }
  for (uint32_t i = 0; i < instances.size(); ++i)
    for (const Surface& surface : models[instances[i].model].surfaces) {
      wt_exact_surface& record = records.emplace_back();
      const glm::dvec3 normal = state.instances[i].rotation * surface.normal;
      store(record.normal, normal);
      record.offset = surface.offset_m;
      for (int axis = 0; axis < 3; ++axis) record.offset += normal[axis] * state.instances[i].position_m[axis];
      record.instance = i;
    }
  return records;
}

std::vector<wt_wedge> wedge_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances) {
  std::vector<wt_wedge> records;
  for (const Wedge& wedge : scene.wedges) records.push_back(record_of(wedge, 0, WT_NONE));
  for (uint32_t i = 0; i < instances.size(); ++i)
    for (const Wedge& wedge : models[instances[i].model].wedges)
      records.push_back(record_of(wedge, instances[i].first_surface, i));
  return records;
}

void place_wedge(wt_wedge& wedge, const WorldState& state) {
  if (wedge.instance == WT_NONE) return;
  const Placement& body = state.instances[wedge.instance];
  store(wedge.start, body.rotation * device::wt_vector(wedge.start) + body.position_m);
  store(wedge.along, body.rotation * device::wt_vector(wedge.along));
  store(wedge.face, body.rotation * device::wt_vector(wedge.face));
  store(wedge.normal, body.rotation * device::wt_vector(wedge.normal));
}

void place_wedges(std::vector<wt_wedge>& wedges, const WorldState& state) {
  for (wt_wedge& wedge : wedges) place_wedge(wedge, state);
}

std::vector<uint32_t> plane_records(const Scene& scene, std::span<const Scene> models,
                                    std::span<const Instance> instances) {
  std::vector<uint32_t> planes;
  const auto add = [&](const Scene& part) {
    const auto first = static_cast<uint32_t>(planes.size());
    for (uint32_t surface = 0; surface < part.surfaces.size(); ++surface) planes.push_back(first + surface);
    for (const Wedge& wedge : part.wedges)
      for (int face = 0; face < 2; ++face) planes[first + wedge.surface[face]] = first + wedge.plane[face];
  };
  add(scene);
  for (const Instance& instance : instances) add(models[instance.model]);
  return planes;
}

std::vector<wt_exact_instance> instance_records(std::span<const Instance> instances, const WorldState& state) {
  std::vector<wt_exact_instance> records(state.instances.size());
  for (size_t i = 0; i < records.size(); ++i) {
    wt_exact_instance& record = records[i];
    const Placement& body = state.instances[i];
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) record.rotation[3 * row + column] = body.rotation[column][row];
    store(record.position, body.position_m);
    store(record.velocity, body.velocity_m_s);
    store(record.angular_velocity, body.angular_velocity_rad_s);
    record.first_surface = instances[i].first_surface;
    record.first_wedge = instances[i].first_wedge;
    record.present = body.present;
  }
  return records;
}

std::vector<wt_target_point> target_records(const WorldState& state) {
  std::vector<wt_target_point> out;
  for (const TargetState& from : state.targets) {
    wt_target_point& to = out.emplace_back();
    for (int row = 0; row < 3; ++row) {
      to.position[row] = from.position_m[row];
      to.velocity[row] = from.velocity_m_s[row];
      for (int column = 0; column < 3; ++column) to.rotation[3 * row + column] = from.rotation[column][row];
    }
    to.instance = from.instance;
    to.law = from.law;
    to.present = from.present ? WT_POINT_PRESENT | (from.lit_above ? WT_POINT_LIT_ABOVE : 0u) |
                                    (from.lit_below ? WT_POINT_LIT_BELOW : 0u)
                              : 0u;
    to.surface = from.surface;
  }
  return out;
}

}  // namespace wavetracer
