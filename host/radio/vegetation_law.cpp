// SPDX-License-Identifier: Apache-2.0
// Kinds of vegetation are the materials of volumes, in the order in which volumes first use them. For A_m: A_1 = 1.37
// dB and alpha = 0.42 were measured in a mixed wood near St. Petersburg from 106 to 2118 MHz, 0.18 dB and 0.752 in a
// deciduous one near Mulhouse from 900 to 1800 MHz; outside of these ranges the law is extrapolated.
#include "radio/vegetation_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/volume_overlaps.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

uint32_t kind_of(VolumeTable& table, uint32_t material) {
  const auto found = std::ranges::find(table.material, material);
  if (found != table.material.end()) return static_cast<uint32_t>(found - table.material.begin());
  if (table.material.size() == WT_MOST_KINDS)
    throw ConfigError(
        fmt::format("the scene has more than {} materials of vegetation: give some of its volumes the same material "
                    "(scene.material_alias)",
                    WT_MOST_KINDS));
  table.material.push_back(material);
  return static_cast<uint32_t>(table.material.size() - 1);
}

constexpr double ratio_at_1_ghz = 1 / 1.2, first_ghz = 9.6, last_ghz = 57.6;

// The laws of COST 235 are 26.6 f^-0.2 d^0.5 dB without leaves and 15.6 f^-0.009 d^0.26 dB in leaf, f in MHz; this is
// their ratio at d = 1 m.
double cost_235_ratio(double ghz) { return 26.6 / 15.6 * std::pow(1000 * ghz, 0.009 - 0.2); }

}  // namespace

double leafless_share(double frequency_hz) {
  const double ghz = frequency_hz / 1e9;
  if (ghz <= 1) return ratio_at_1_ghz;
  if (ghz >= first_ghz) return cost_235_ratio(std::min(ghz, last_ghz));
  return ratio_at_1_ghz * std::pow(cost_235_ratio(first_ghz) / ratio_at_1_ghz, std::log(ghz) / std::log(first_ghz));
}

VegetationLoss vegetation_loss(const VegetationLaw& law, double frequency_hz) {
  const double ghz = frequency_hz / 1e9;
  const double most_db = law.deciduous ? 0.18 * std::pow(1000 * ghz, 0.752) : 1.37 * std::pow(1000 * ghz, 0.42);
  return {law.attenuation_db_m.value_or(0.2 * ghz * (law.in_leaf ? 1 : leafless_share(frequency_hz))),
          law.max_attenuation_db.value_or(most_db)};
}

VolumeTable volume_table(const Scene& scene) {
  VolumeTable out;
  for (const Volume& volume : scene.volumes) {
    device::wt_volume record{};
    for (int axis = 0; axis < 3; ++axis) {
      record.centre[axis] = volume.centre[axis];
      record.half_size[axis] = volume.half_size[axis];
    }
    record.cosine = std::cos(volume.yaw_rad);
    record.sine = std::sin(volume.yaw_rad);
    record.shape = static_cast<uint32_t>(volume.shape);
    record.kind = kind_of(out, volume.material);
    record.first_triangle = static_cast<uint32_t>(out.triangles.size() / 9);
    record.triangle_count = static_cast<uint32_t>(volume.triangles.size());
    for (const auto& triangle : volume.triangles)
      for (const glm::dvec3& corner : triangle)
        out.triangles.insert(out.triangles.end(), {corner.x, corner.y, corner.z});
    out.volumes.push_back(record);
  }
  const std::vector<std::vector<uint32_t>> earlier = earlier_volumes(scene.volumes);
  out.earlier.assign(1, static_cast<uint32_t>(earlier.size() + 1));
  for (const auto& list : earlier) out.earlier.push_back(out.earlier.back() + static_cast<uint32_t>(list.size()));
  for (const auto& list : earlier) out.earlier.insert(out.earlier.end(), list.begin(), list.end());
  return out;
}

std::vector<device::wt_foliage> foliages_at(const VolumeTable& table, const Scene& scene, double frequency_hz) {
  std::vector<device::wt_foliage> out;
  for (const uint32_t material : table.material) {
    const Material& leaves = scene.materials[material];
    const VegetationLoss loss = vegetation_loss(*leaves.vegetation, frequency_hz);
    const double np_of_db = std::numbers::ln10 / 20;
    out.push_back({loss.db_m * np_of_db, std::isinf(loss.most_db) ? -1 : loss.most_db * np_of_db, leaves.scattering,
                   leaves.scattering_cross_polar});
  }
  return out;
}

}  // namespace wavetracer
