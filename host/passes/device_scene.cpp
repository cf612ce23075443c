// Upload of the static scene: trees by host/accel, surfaces as the records of wavetracer/device/records.h.
// Stack sizes follow from the trees, in steps, so that scenes of like size share compiled kernels.
#include "passes/device_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "accel/layout.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

namespace {

std::string stack_size(uint32_t entries, uint32_t step) { return std::to_string((entries + step) / step * step); }

// Pairs (minimum, maximum) to (centre, half size). The half size is padded by 16 units in the last place of the largest
// distance: the slab test rounds four times, the sheared vertices of the triangle test three times, each by at most one
// unit of a coordinate or of a distance of twice that size.
std::vector<float> centred(std::vector<float> nodes, float extent_m) {
  const double padding = 16.0 * 6e-8 * 2.0 * static_cast<double>(extent_m);
  for (size_t node = 0; node < nodes.size(); node += WT_BVH2_NODE_FLOATS)
    for (size_t pair = node; pair < node + 12; pair += 2) {
      const double lower = static_cast<double>(nodes[pair]), upper = static_cast<double>(nodes[pair + 1]);
      const bool unused = !(lower <= upper);
      const float centre = unused ? 0.0f : static_cast<float>(0.5 * (lower + upper));
      nodes[pair] = centre;
      nodes[pair + 1] = unused ? -1.0f - static_cast<float>(padding)
                               : std::nextafter(static_cast<float>(std::max(upper - static_cast<double>(centre),
                                                                            static_cast<double>(centre) - lower) +
                                                                   padding),
                                                std::numeric_limits<float>::infinity());
    }
  return nodes;
}

void upload_surfaces(gpu::Context& context, const Scene& scene, DeviceScene& out) {
  std::vector<wt_surface> surfaces;
  std::vector<wt_exact_surface> exact;
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
    surfaces.push_back(record);
    exact.push_back(exact_record);
  }
  std::vector<double> corners;
  corners.reserve(9 * scene.surface_triangles.size());
  for (const uint32_t triangle : scene.surface_triangles)
    for (const uint32_t vertex : scene.triangles[triangle])
      for (int axis = 0; axis < 3; ++axis) corners.push_back(scene.vertices[vertex][axis]);
  out.surfaces = context.buffer(surfaces, "surfaces");
  out.exact_surfaces = context.buffer(exact, "exact surfaces");
  out.exact_triangles = context.buffer(corners, "surface triangles");
}

}  // namespace

DeviceScene make_device_scene(gpu::Context& context, const Scene& scene, bool spatial_splits, double reach_m) {
  DeviceScene out;
  out.extent_m = static_cast<float>(reach_m);
  for (int axis = 0; axis < 3; ++axis)
    out.extent_m =
        std::max(out.extent_m, static_cast<float>(std::max(std::abs(scene.lower[axis]), std::abs(scene.upper[axis]))));
  out.cpu = context.info().cpu;
  const std::vector<AccelTriangle> triangles = accel_triangles(scene);

  BuildOptions options = BuildOptions::for_bvh2();
  options.spatial_splits = spatial_splits;
  const Bvh2 two = make_bvh2(build_binary(triangles, options), triangles);
  out.triangle_slots = two.triangle_slots;
  out.nodes2 = context.buffer(centred(two.nodes, out.extent_m), "BVH2 nodes");
  out.triangles2 = context.buffer(two.triangles, "BVH2 triangles");
  out.definitions["WT_BVH2_STACK"] = out.definitions["WT_PACKET_STACK"] = stack_size(two.max_depth, 32);
  if (out.cpu) {
    out.packet_nodes2 = context.buffer(two.nodes, "BVH2 packet nodes");
    options = BuildOptions::for_bvh8();
    options.spatial_splits = spatial_splits;
    const Bvh8 eight = make_bvh8(build_binary(triangles, options), triangles);
    out.nodes8 = context.buffer(eight.nodes, "BVH8 nodes");
    out.blocks8 = context.buffer(eight.blocks, "BVH8 blocks");
    out.definitions["WT_BVH8_STACK"] = stack_size(7 * eight.max_depth + 1, 64);
  }
  upload_surfaces(context, scene, out);
  return out;
}

}  // namespace wavetracer
