// SPDX-License-Identifier: Apache-2.0
// A centre is inside if a short leg that leaves it upwards is: the same rule as for the losses of paths inside.
#include "radio/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "radio/vegetation_law.hpp"
#include "wavetracer/device/volumes.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
using Counts = std::array<uint64_t, 3>;

constexpr double probe_m = 1e-6;

bool scatters(const Scene& scene, const Volume& volume) { return scene.materials[volume.material].scattering > 0; }

double exact_m3(const Volume& volume) {
  const dvec3& h = volume.half_size;
  switch (volume.shape) {
    case VolumeShape::box:
      return 8 * h.x * h.y * h.z;
    case VolumeShape::cylinder:
      return 2 * std::numbers::pi * h.x * h.y * h.z;
    case VolumeShape::spheroid:
      return 4 * std::numbers::pi / 3 * h.x * h.y * h.z;
    case VolumeShape::mesh:
      break;
  }
  double six_volumes = 0;
  for (const auto& [a, b, c] : volume.triangles)
    six_volumes += glm::dot(a - volume.centre, glm::cross(b - volume.centre, c - volume.centre));
  return six_volumes / 6;
}

Counts counts_of(const Volume& volume, double cell_m) {
  Counts out;
  for (int axis = 0; axis < 3; ++axis)
    out[static_cast<size_t>(axis)] =
        static_cast<uint64_t>(std::clamp(std::ceil(2 * volume.half_size[axis] / cell_m), 1.0, 1e9));
  return out;
}

double boxes_in(const Counts& n) {
  return static_cast<double>(n[0]) * static_cast<double>(n[1]) * static_cast<double>(n[2]);
}

// Is the upright leg of a micrometre that begins at the centre inside?
bool holds(const device::wt_volume& record, const double* triangles, const dvec3& centre) {
  return device::wt_length_inside(&record, triangles, centre, centre + dvec3(0, 0, probe_m)) > probe_m / 2;
}

// The centres of the boxes, those that are inside.
std::vector<dvec3> centres_inside(const Volume& volume, const device::wt_volume& record, const double* triangles,
                                  const Counts& n) {
  std::vector<dvec3> out;
  for (uint64_t k = 0; k < n[2]; ++k)
    for (uint64_t j = 0; j < n[1]; ++j)
      for (uint64_t i = 0; i < n[0]; ++i) {
        const dvec3 share((2.0 * static_cast<double>(i) + 1) / static_cast<double>(n[0]) - 1,
                          (2.0 * static_cast<double>(j) + 1) / static_cast<double>(n[1]) - 1,
                          (2.0 * static_cast<double>(k) + 1) / static_cast<double>(n[2]) - 1);
        const dvec3 p = share * volume.half_size;
        const dvec3 centre = volume.centre + dvec3(record.cosine * p.x - record.sine * p.y,
                                                   record.sine * p.x + record.cosine * p.y, p.z);
        if (holds(record, triangles, centre)) out.push_back(centre);
      }
  return out;
}

}  // namespace

bool has_cells(const Scene& scene) {
  return std::ranges::any_of(scene.volumes, [&](const Volume& volume) { return scatters(scene, volume); });
}

std::vector<Cell> make_cells(const Scene& scene, double cell_m, uint64_t most) {
  std::vector<Cell> out;
  if (!has_cells(scene)) return out;
  double boxes = 0;
  for (const Volume& volume : scene.volumes)
    if (scatters(scene, volume)) boxes += boxes_in(counts_of(volume, cell_m));
  if (boxes > static_cast<double>(most))
    throw ConfigError(
        fmt::format("trace.tile_m = {:g} cuts the vegetation that scatters into {:.3g} cells, but at most {} are "
                    "possible: make it larger (twice as long cells are an eighth as many). Every cell is one path for "
                    "each link",
                    cell_m, boxes, most));
  const VolumeTable table = volume_table(scene);
  for (uint32_t i = 0; i < scene.volumes.size(); ++i) {
    const Volume& volume = scene.volumes[i];
    const double volume_m3 = exact_m3(volume);
    if (!scatters(scene, volume) || !(volume_m3 > 0)) continue;
    // A mesh may fill little of its box: boxes get smaller until half of the volume is found.
    Counts n = counts_of(volume, cell_m);
    std::vector<dvec3> centres;
    for (int finer = 0; finer < 6; ++finer) {
      centres = centres_inside(volume, table.volumes[i], table.triangles.data(), n);
      const double box_m3 = 8 * volume.half_size.x * volume.half_size.y * volume.half_size.z / boxes_in(n);
      if (static_cast<double>(centres.size()) * box_m3 > volume_m3 / 2) break;
      for (uint64_t& count : n) count *= 2;
    }
    const device::wt_volumes all = table.all();
    const auto earlier_holds = [&](const dvec3& centre) {
      for (uint32_t k = table.earlier[i]; k < table.earlier[i + 1]; ++k)
        if (holds(*device::wt_earlier(all, k), table.triangles.data(), centre)) return true;
      return false;
    };
    for (const dvec3& centre : centres)
      if (!earlier_holds(centre)) out.push_back({centre, volume_m3 / static_cast<double>(centres.size()), i});
  }
  return out;
}

}  // namespace wavetracer
