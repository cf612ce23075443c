// SPDX-License-Identifier: Apache-2.0
#include "radio/reflectance_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "radio/constants.hpp"
#include "wavetracer/device/layers.h"

namespace wavetracer {
namespace {

constexpr double most_turn_rad = 0.05, margin = 1.01, least_samples = 16, most_samples = 4096;

double size2(const device::wt_double2& z) { return z.x * z.x + z.y * z.y; }

// The larger one of both polarisations, and of both sides of a wall.
double reflectance(std::span<const device::wt_material> table, const device::wt_material& material, double cosine,
                   double wavelength_m) {
  const device::wt_double2 permittivity{material.permittivity[0], material.permittivity[1]};
  double most = 0;
  for (const int along_normal : {0, 1}) {
    if (along_normal && material.layers == 0) break;
    const device::wt_layers layers = device::wt_layers_of(table.data(), material.layers, along_normal);
    const device::wt_slab slab =
        device::wt_wall_coefficients(layers, permittivity, cosine, material.thickness_m, wavelength_m);
    most = std::max({most, size2(slab.reflection_te), size2(slab.reflection_tm)});
  }
  return most;
}

bool conducts(const device::wt_material& material) {
  return std::hypot(material.permittivity[0], material.permittivity[1]) > WT_CONDUCTS;
}

// The thickness that has a phase.
double finite_m(const device::wt_material& material) {
  return std::isinf(material.thickness_m) ? 0.0 : material.thickness_m;
}

}  // namespace

CosineBounds reflectance_bounds(std::span<const device::wt_material> table, size_t index, double wavelength_m) {
  CosineBounds out;
  out.fill(1.0f);
  const device::wt_material& material = table[index];
  const uint32_t count = material.layers & WT_LAYER_COUNT;
  const auto parts = count > 0 ? table.subspan(material.layers >> WT_LAYER_SHIFT, count) : table.subspan(index, 1);
  // The phase 4 pi (d / lambda) s changes by at most 4 pi d / lambda over the cosines from 0 to 1, as s^2 = eta - 1 +
  // cosine^2. A half space has no such phase. Those of several layers add up.
  double turn = 0;
  for (const device::wt_material& part : parts) turn += 4 * WT_PI * finite_m(part) / wavelength_m;
  const double samples = std::max(least_samples, std::ceil(turn / WT_COSINES / most_turn_rad));
  if (std::ranges::any_of(parts, conducts) || !(samples <= most_samples)) return out;
  for (uint32_t k = 0; k < WT_COSINES; ++k) {
    double most = 0;
    for (uint32_t i = 0; i <= static_cast<uint32_t>(samples); ++i)
      most = std::max(most, reflectance(table, material, (k + i / samples) / WT_COSINES, wavelength_m));
    out[k] = static_cast<float>(std::min(1.0, margin * most));
  }
  return out;
}

ReflectanceBounds make_reflectance_bounds(const Scene& scene, std::span<const Scene> models,
                                          std::span<const Instance> instances, std::span<const double> frequencies_hz) {
  ReflectanceBounds out;
  for (const double frequency_hz : frequencies_hz) {
    MaterialTable table = make_material_table(scene, models, instances, frequency_hz);
    out.bounds.resize(table.materials.size() * WT_COSINES);
    for (size_t i = 0; i < table.materials.size(); ++i) {
      const CosineBounds bounds = reflectance_bounds(table.materials, i, speed_of_light_m_s / frequency_hz);
      for (uint32_t k = 0; k < WT_COSINES; ++k) {
        float& most = out.bounds[i * WT_COSINES + k];
        most = std::max(most, bounds[k]);
      }
    }
    out.materials_of = std::move(table.materials_of);
  }
  return out;
}

ReflectanceBounds lossless_mirrors(size_t surfaces) {
  return {.bounds = std::vector<float>(WT_COSINES, 1.0f), .materials_of = std::vector<uint32_t>(surfaces)};
}

}  // namespace wavetracer
