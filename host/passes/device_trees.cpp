// SPDX-License-Identifier: Apache-2.0
// Trees by host/accel, uploaded in the layouts of wavetracer/device/bvh.h.
// Stack sizes follow from the trees, in steps, so that scenes of similar size share compiled kernels.
#include "passes/device_trees.hpp"

#include <algorithm>

#include "accel/layout.hpp"
#include "passes/advice.hpp"

namespace wavetracer {

void DeviceTrees::require_stack(const std::string& name, uint32_t entries) {
  const uint32_t step = name == "WT_BVH8_STACK" ? 64 : 32;
  std::string& size = definitions[name];
  size = std::to_string(
      std::max((entries + step) / step * step, size.empty() ? 0u : static_cast<uint32_t>(std::stoul(size))));
}

DeviceTrees make_device_trees(gpu::Context& context, std::span<const AccelTriangle> triangles, bool spatial_splits,
                              float extent_m) {
  DeviceTrees out;
  out.extent_m = extent_m;
  out.primitive_count = static_cast<uint32_t>(triangles.size());
  if (out.extent_m > largest_scene_of_float32_m) out.definitions["WT_NEAR_MISSES"] = "1";
  out.cpu = context.info().cpu;

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
  out.moving = context.buffer<wt_float4>(1, "moving");
  return out;
}

}  // namespace wavetracer
