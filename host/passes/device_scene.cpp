// SPDX-License-Identifier: Apache-2.0
// Upload of the static scene: trees by host/accel, surfaces as the records of wavetracer/device/records.h.
// Stack sizes follow from the trees, in steps, so that scenes of similar size share compiled kernels.
#include "passes/device_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "accel/layout.hpp"
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

void DeviceScene::require_stack(const std::string& name, uint32_t entries) {
  const uint32_t step = name == "WT_BVH8_STACK" ? 64 : 32;
  std::string& size = definitions[name];
  size = std::to_string(
      std::max((entries + step) / step * step, size.empty() ? 0u : static_cast<uint32_t>(std::stoul(size))));
}

DeviceScene make_device_scene(gpu::Context& context, const Scene& scene, bool spatial_splits, double reach_m,
                              const std::vector<bool>& opaque) {
  DeviceScene out;
  out.extent_m = static_cast<float>(reach_m);
  for (int axis = 0; axis < 3; ++axis)
    out.extent_m =
        std::max(out.extent_m, static_cast<float>(std::max(std::abs(scene.lower[axis]), std::abs(scene.upper[axis]))));
  if (out.extent_m > largest_scene_of_float32_m) out.definitions["WT_NEAR_MISSES"] = "1";
  out.cpu = context.info().cpu;
  const std::vector<AccelTriangle> triangles = accel_triangles(scene);

  BuildOptions options = BuildOptions::for_bvh2();
  options.spatial_splits = spatial_splits;
  const Bvh2 two = make_bvh2(build_binary(triangles, options), triangles);
  out.triangle_slots = two.triangle_slots;
  out.nodes2 = context.buffer(centred_nodes(two.nodes, out.extent_m), {"BVH2 nodes", advice::scene});
  out.triangles2 = context.buffer(two.triangles, {"BVH2 triangles", advice::scene});
  out.require_stack("WT_BVH2_STACK", two.max_depth);
  out.require_stack("WT_PACKET_STACK", two.max_depth);
  if (out.cpu) {
    out.packet_nodes2 = context.buffer(two.nodes, {"BVH2 packet nodes", advice::scene});
    options = BuildOptions::for_bvh8();
    options.spatial_splits = spatial_splits;
    const Bvh8 eight = make_bvh8(build_binary(triangles, options), triangles);
    out.nodes8 = context.buffer(eight.nodes, {"BVH8 nodes", advice::scene});
    out.blocks8 = context.buffer(eight.blocks, {"BVH8 blocks", advice::scene});
    out.require_stack("WT_BVH8_STACK", 7 * eight.max_depth + 1);
  }
  const SurfaceRecords records = device_surfaces(scene, 0, opaque);
  out.surfaces = context.buffer(records.surfaces, {"surfaces", advice::scene});
  out.exact_surfaces = context.buffer(records.exact, {"exact surfaces", advice::scene});
  out.exact_triangles = context.buffer(surface_corners(scene), {"surface triangles", advice::scene});
  out.exact_instances = context.buffer<wt_exact_instance>(1, "instances");
  out.moving = context.buffer<wt_float4>(1, "moving");
  out.primitive_count = static_cast<uint32_t>(scene.triangles.size());
  return out;
}

}  // namespace wavetracer
