// Host side of kernels/wedges.cl.
// One wedge of an instance per work-item; the lists of surfaces do not change with frames.
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

}  // namespace

Wedges::Wedges(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models,
               const std::vector<Instance>& instances, bool free_edges)
    : kernel_(context.kernel("wedges", "wedges")), local_(context.info().simple_local_size()) {
  const std::vector<wt_wedge> records = wedge_records(scene, models, instances);
  static_count_ = static_cast<uint32_t>(scene.wedges.size());
  size_t surfaces = scene.surfaces.size();
  for (const Instance& instance : instances) surfaces += models[instance.model].surfaces.size();
  moving_count_ = static_cast<uint32_t>(records.size()) - static_count_;

  std::vector<uint32_t> first(surfaces + 1, 0);
  const auto visit = [&](const auto& act) {
    for (uint32_t k = 0; k < records.size(); ++k) {
      const wt_wedge& wedge = records[k];
      if (!free_edges && wedge.exterior > half_plane_rad) continue;
      act(k, wedge.surfaces[0]);
      if (wedge.surfaces[1] != wedge.surfaces[0]) act(k, wedge.surfaces[1]);
    }
  };
  visit([&](uint32_t, uint32_t surface) { ++first[surface + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<uint32_t> of_surfaces(first.back()), next = first;
  visit([&](uint32_t wedge, uint32_t surface) { of_surfaces[next[surface]++] = wedge; });
  diffracting_ = static_cast<uint32_t>(std::ranges::count_if(
      records, [&](const wt_wedge& wedge) { return free_edges || wedge.exterior <= half_plane_rad; }));

  list_.wedges = context.buffer(records, {"wedges", advice::scene});
  models_ = context.buffer(std::vector<wt_wedge>(records.begin() + static_count_, records.end()),
                           {"model wedges", advice::scene});
  list_.first = context.buffer(first, "first wedges of surfaces");
  list_.of_surfaces = context.buffer(of_surfaces, {"wedges of surfaces", advice::scene});
}

unsigned Wedges::key_bits() const {
  return static_cast<unsigned>(std::bit_width(wt_wedge_key(static_cast<uint32_t>(static_count_ + moving_count_), 31u)));
}

void Wedges::operator()(const DeviceScene& scene) {
  if (moving_count_ > 0)
    kernel_({moving_count_, local_}, "wedges", scene.exact_instances, models_, static_count_, moving_count_,
            list_.wedges);
}

}  // namespace wavetracer
