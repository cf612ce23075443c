// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/vehicles/wedges.cl.
// A work-item takes one wedge of an instance; the lists of surfaces do not change with frames.
#include "passes/wedges.hpp"

#include <algorithm>
#include <bit>
#include <numbers>
#include <numeric>

#include "passes/advice.hpp"
#include "radio/world_records.hpp"

namespace wavetracer {

namespace {

constexpr double half_plane_rad = 2 * std::numbers::pi - 1e-6;

// The normals of all surfaces of the world, those of instances in the coordinates of their models.
std::vector<glm::dvec3> surface_normals(const Scene& scene, const std::vector<Scene>& models,
                                        const std::vector<Instance>& instances) {
  std::vector<glm::dvec3> normals;
  for (const Surface& surface : scene.surfaces) normals.push_back(surface.normal);
  for (const Instance& instance : instances)
    for (const Surface& surface : models[instance.model].surfaces) normals.push_back(surface.normal);
  return normals;
}

// From which side of the surface of this face is the wedge seen? 0: the side against its normal, 2: the other one, 1:
// both. A corner is only seen from the side of its free space.
uint32_t seen_from(const wt_wedge& wedge, int face, const glm::dvec3& normal) {
  if (wedge.exterior >= std::numbers::pi) return 1;
  double out = 0;
  for (int axis = 0; axis < 3; ++axis)
    out += normal[axis] *
           (face == 0 ? wedge.normal[axis] : wedge.sine * wedge.face[axis] - wedge.cosine * wedge.normal[axis]);
  return out > 0 ? 2 : 0;
}

}  // namespace

Wedges::Wedges(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models,
               const std::vector<Instance>& instances, bool free_edges)
    : kernel_(context), local_(context.info().simple_local_size()) {
  const std::vector<wt_wedge> records = wedge_records(scene, models, instances);
  static_count_ = static_cast<uint32_t>(scene.wedges.size());
  moving_count_ = static_cast<uint32_t>(records.size()) - static_count_;
  const std::vector<glm::dvec3> normals = surface_normals(scene, models, instances);

  // Each surface has three lists, one after the other: wedges seen from the side against its normal, from both, from
  // the other side.
  std::vector<uint32_t> next(3 * normals.size() + 1, 0);
  const auto visit = [&](const auto& act) {
    for (uint32_t k = 0; k < records.size(); ++k) {
      const wt_wedge& wedge = records[k];
      if (!free_edges && wedge.exterior > half_plane_rad) continue;
      for (int face = 0; face < (wedge.surfaces[1] == wedge.surfaces[0] ? 1 : 2); ++face)
        act(k, 3 * wedge.surfaces[face] + seen_from(wedge, face, normals[wedge.surfaces[face]]));
    }
  };
  visit([&](uint32_t, uint32_t list) { ++next[list + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<uint32_t> first, sides;
  for (size_t list = 0; list < next.size(); ++list) (list % 3 == 0 ? first : sides).push_back(next[list]);
  std::vector<uint32_t> of_surfaces(next.back());
  visit([&](uint32_t wedge, uint32_t list) { of_surfaces[next[list]++] = wedge; });
  diffracting_ = static_cast<uint32_t>(std::ranges::count_if(
      records, [&](const wt_wedge& wedge) { return free_edges || wedge.exterior <= half_plane_rad; }));

  list_.wedges = context.buffer(records, {"wedges", advice::scene});
  models_ = context.buffer(std::vector<wt_wedge>(records.begin() + static_count_, records.end()),
                           {"model wedges", advice::scene});
  list_.first = context.buffer(first, "first wedges of surfaces");
  list_.sides = context.buffer(sides, {"wedges of sides of surfaces", advice::scene});
  list_.of_surfaces = context.buffer(of_surfaces, {"wedges of surfaces", advice::scene});
}

unsigned Wedges::key_bits() const {
  return static_cast<unsigned>(std::bit_width(wt_wedge_key(static_cast<uint32_t>(static_count_ + moving_count_), 31u)));
}

void Wedges::operator()(const DeviceScene& scene) {
  if (moving_count_ > 0)
    kernel_({moving_count_, local_}, Stage::wedges,
            calls::wedges::wedges{.instances = scene.exact_instances,
                                  .models = models_,
                                  .first = static_count_,
                                  .count = moving_count_,
                                  .out = list_.wedges});
}

}  // namespace wavetracer
