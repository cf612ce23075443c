// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_sight.cl.
// One prefix per work-item.
#include "passes/wedge_sight.hpp"

#include "scene/convex_faces.hpp"

namespace wavetracer {
namespace {

std::vector<double> numbers(const std::vector<glm::dvec4>& sides) {
  std::vector<double> out;
  for (const glm::dvec4& side : sides) out.insert(out.end(), {side.x, side.y, side.z, side.w});
  if (out.empty()) out.resize(4);  // buffers are never empty
  return out;
}

}  // namespace

WedgeSight::WedgeSight(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission,
                       uint32_t pieces)
    : kernel_(context, device_scene.definitions),
      count_(context, device_scene.definitions),
      work_(tuning_of(context.info()).exact),
      transmission_(transmission),
      pieces_(pieces),
      seen_(context.buffer<uint32_t>(1, "number of prefixes in sight")) {
  const ConvexFaces faces = convex_faces(scene);
  first_sides_ = context.buffer(faces.first, "first sides of surfaces");
  sides_ = context.buffer(numbers(faces.sides), "sides of surfaces");
}

wt_sight_arguments WedgeSight::arguments(const DeviceScene& scene, uint32_t count, uint32_t kept_wedges) const {
  return {.count = count,
          .ends = WT_NONE,
          .pieces = pieces_,
          .triangle_slots = scene.triangle_slots,
          .extent_m = scene.extent_m,
          .static_surfaces = static_cast<uint32_t>(first_sides_.size() - 1),
          .only_opaque = transmission_,
          .kept_wedges = kept_wedges};
}

void WedgeSight::operator()(const DeviceScene& scene, const WedgeList& wedges, const gpu::Buffer<uint64_t>& trie,
                            WedgePrefixList& prefixes, uint32_t ends) {
  if (prefixes.count == 0) return;
  wt_sight_arguments args = arguments(scene, prefixes.count, 0);
  args.ends = ends;
  kernel_(work_.range(prefixes.count), Stage::wedge_sight,
          calls::wedge_sight::wedge_sight{.nodes = scene.leg_nodes(),
                                          .triangles = scene.leg_leaves(),
                                          .surfaces = scene.exact_surfaces,
                                          .first_sides = first_sides_,
                                          .sides = sides_,
                                          .boxes = scene.surfaces,
                                          .wedges = wedges.wedges,
                                          .table = trie,
                                          .keys = prefixes.keys,
                                          .prefixes = prefixes.prefixes,
                                          .args = args});
}

uint32_t WedgeSight::in_sight(const WedgePrefixList& prefixes) {
  if (prefixes.count == 0) return 0;
  count_(work_.range(prefixes.count), Stage::wedge_sight,
         calls::wedge_sight::count_in_sight{.keys = prefixes.keys, .seen = seen_, .count = prefixes.count});
  return seen_.read(0, 1, Stage::wedge_sight)[0];
}

}  // namespace wavetracer
