// SPDX-License-Identifier: Apache-2.0
// Upload of the static scene: trees by device_trees, surfaces as the records of wavetracer/device/records.h.
#include "passes/device_scene.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "passes/advice.hpp"

namespace wavetracer {

SurfaceRecords device_surfaces(const Scene& scene, size_t more, const std::vector<bool>& opaque) {
  SurfaceRecords out;
  for (const Surface& s : scene.surfaces) {
    wt_surface record{};
    wt_exact_surface exact_record{};
    for (int axis = 0; axis < 3; ++axis) {
      record.normal[axis] = static_cast<float>(s.normal[axis]);
      record.lower[axis] = static_cast<float>(s.lower[axis]);
      record.upper[axis] = static_cast<float>(s.upper[axis]);
      exact_record.normal[axis] = s.normal[axis];
    }
    record.offset = static_cast<float>(s.offset_m);
    exact_record.offset = s.offset_m;
    exact_record.first_triangle = s.first_triangle;
    exact_record.triangle_count = s.triangle_count;
    exact_record.instance = WT_NONE;
    out.surfaces.push_back(record);
    out.exact.push_back(exact_record);
  }
  const size_t all = scene.surfaces.size() + more;
  out.surfaces.resize(all);
  out.exact.resize(all);
  for (size_t i = 0; i < all && !opaque.empty(); ++i) out.exact[i].opaque = opaque.at(i);
  return out;
}

std::vector<double> surface_corners(const Scene& scene) {
  std::vector<double> corners;
  corners.reserve(9 * scene.surface_triangles.size());
  for (const uint32_t triangle : scene.surface_triangles)
    for (const uint32_t vertex : scene.triangles[triangle])
      for (int axis = 0; axis < 3; ++axis) corners.push_back(scene.vertices[vertex][axis]);
  return corners;
}

DeviceScene make_device_scene(gpu::Context& context, const Scene& scene, bool spatial_splits, double reach_m,
                              const std::vector<bool>& opaque) {
  auto extent_m = static_cast<float>(reach_m);
  for (int axis = 0; axis < 3; ++axis)
    extent_m =
        std::max(extent_m, static_cast<float>(std::max(std::abs(scene.lower[axis]), std::abs(scene.upper[axis]))));
  DeviceScene out;
  static_cast<DeviceTrees&>(out) = make_device_trees(context, accel_triangles(scene), spatial_splits, extent_m);
  const SurfaceRecords records = device_surfaces(scene, 0, opaque);
  out.surfaces = context.buffer(records.surfaces, {"surfaces", advice::scene});
  out.exact_surfaces = context.buffer(records.exact, {"exact surfaces", advice::scene});
  out.exact_triangles = context.buffer(surface_corners(scene), {"surface triangles", advice::scene});
  out.exact_instances = context.buffer<wt_exact_instance>(1, "instances");
  return out;
}

}  // namespace wavetracer
