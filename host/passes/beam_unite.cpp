// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_unite.cl.
#include "passes/beam_unite.hpp"

#include <bit>

#include "passes/advice.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {
namespace {

gpu::Definitions definitions_of(uint32_t lanes) { return {{"WT_LANES", std::to_string(lanes) + "u"}}; }

}  // namespace

BeamUnite::BeamUnite(gpu::Context& context)
    : context_(context),
      lanes_(tuning_of(context.info()).visible_lanes),
      link_(context, definitions_of(lanes_)),
      unite_(context, definitions_of(lanes_)) {}

// The heads of lists are as unite_ leaves them, so a call that fails between leaves none.
uint32_t BeamUnite::operator()(const DeviceScene& scene, BeamLists& lists, uint32_t count, const Trie& set) try {
  const uint32_t none = WT_NONE, zero = 0;
  const auto count_from_zero = [&] {
    context_.fill(lists.counters, &zero, sizeof zero, offsetof(wt_beam_counters, apertures), sizeof zero,
                  Stage::beam_visible);
  };
  if (lists.apertures.size() < count)
    lists.apertures = context_.buffer<wt_aperture>(lists.next.size(), {"apertures", advice::beams});
  if (before_.size() < count)
    before_ = context_.buffer<uint32_t>(std::bit_ceil(count), {"lists of apertures", advice::beams});
  if (last_.size() != set.table.size()) {
    last_ = context_.buffer<uint32_t>(set.table.size(), {"lists of apertures", advice::beams});
    context_.fill(last_, &none, sizeof none, 0, last_.bytes(), Stage::beam_visible);
  }
  count_from_zero();
  link_({count, context_.info().simple_local_size()}, Stage::beam_visible,
        calls::beam_unite::beam_link{.apertures = lists.next, .count = count, .last = last_, .before = before_});
  unite_({size_t{count} * lanes_, lanes_}, Stage::beam_visible,
         calls::beam_unite::beam_unite{.apertures = lists.next,
                                       .surfaces = scene.exact_surfaces,
                                       .last = last_,
                                       .before = before_,
                                       .out = lists.apertures,
                                       .counters = lists.counters});
  const uint32_t united = lists.counters.read_one(0, Stage::beam_visible).apertures;
  count_from_zero();
  return united;
} catch (...) {
  last_ = gpu::Buffer<uint32_t>{};
  throw;
}

}  // namespace wavetracer
