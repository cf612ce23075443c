// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_moving.cl.
#include "passes/beam_moving.hpp"

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"

namespace wavetracer {

BeamMoving::BeamMoving(gpu::Context& context)
    : context_(context),
      kernel_(context, {{"WT_LANES", "1u"}}),
      boxes_(context.buffer<wt_instance_box>(1, {"boxes of instances", advice::scene})) {}

void BeamMoving::place(const std::vector<wt_instance_box>& boxes) {
  if (boxes_.size() < boxes.size())
    boxes_ = context_.buffer<wt_instance_box>(boxes.size(), {"boxes of instances", advice::scene});
  boxes_.write(boxes, 0, Stage::beam_gather);
  box_count_ = static_cast<uint32_t>(boxes.size());
}

uint32_t BeamMoving::operator()(const DeviceScene& scene, const KeptApertures& kept, BeamLists& lists, uint32_t count,
                                uint32_t walls) {
  if (box_count_ == 0 || kept.count == 0) return count;
  const auto set_count = [&](uint32_t apertures) {
    context_.fill(lists.counters, &apertures, sizeof apertures, offsetof(wt_beam_counters, apertures), sizeof apertures,
                  Stage::beam_gather);
  };
  set_count(count);
  const uint32_t found = grow_until_filled(
      [&] {
        kernel_({kept.count, context_.info().simple_local_size()}, Stage::beam_gather,
                calls::beam_moving::beam_moving{.surfaces = scene.exact_surfaces,
                                                .apertures = kept.apertures,
                                                .outlooks = kept.outlooks,
                                                .aperture_count = kept.count,
                                                .boxes = boxes_,
                                                .box_count = box_count_,
                                                .out = lists.apertures,
                                                .capacity = static_cast<uint32_t>(lists.apertures.size()),
                                                .counters = lists.counters,
                                                .walls = walls});
      },
      [&] { return lists.counters.read_one(0, Stage::beam_gather).apertures; }, [&] { return lists.apertures.size(); },
      [&](size_t apertures) {
        auto more = context_.buffer<wt_aperture>(apertures, {"apertures", advice::beams});
        context_.copy(lists.apertures, more, count * sizeof(wt_aperture), Stage::beam_gather);
        lists.apertures = std::move(more);
        set_count(count);
      });
  set_count(0);
  return found;
}

}  // namespace wavetracer
