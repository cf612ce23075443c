// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/distinct.cl.
// One row per work-item; two rows per visible path where links have one the other way.
#include "passes/distinct.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "passes/advice.hpp"
#include "wavetracer/device/path_rows.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t most_length_bits = 28;  // see row_key

}  // namespace

Distinct::Distinct(gpu::Context& context, std::span<const uint32_t> receiver_of,
                   std::span<const uint32_t> transmitter_of)
    : context_(context),
      row_keys_(context),
      mark_rows_(context),
      order_rows_(context),
      local_(context.info().simple_local_size()),
      twins_(std::ranges::any_of(receiver_of, [](uint32_t receiver) { return receiver != WT_NONE; })),
      receiver_of_(context.buffer(std::vector(receiver_of.begin(), receiver_of.end()), "receivers of transmitters")),
      transmitter_of_(
          context.buffer(std::vector(transmitter_of.begin(), transmitter_of.end()), "transmitters of receivers")) {
  reserve(1 << 13);
}

void Distinct::reserve(size_t places) {
  order_ = context_.buffer<uint32_t>(places, {"order of paths", advice::links});
  lengths_ = context_.buffer<double>(places, {"lengths of paths", advice::links});
  stays_ = context_.buffer<uint8_t>(places, {"distinct paths", advice::links});
  quarters_ = context_.buffer<uint8_t>(places, {"quarters of paths", advice::links});
  rows_.rows = context_.buffer<uint32_t>(places, {"rows of paths", advice::links});
  rows_.counts = context_.buffer<uint32_t>(2 * places, {"counts of rows and vertices", advice::links});
  rows_.delays = context_.buffer<double>(places, {"delays of paths", advice::links});
  rows_.quarters = context_.buffer<uint8_t>(places, {"quarters of rows", advice::links});
  keys_ = context_.buffer<uint32_t>(places, {"keys of paths", advice::links});  // last: its size is the room
}

uint32_t Distinct::keys(const RadioEnds& ends, const gpu::Buffer<uint16_t>& own, const SolvedList& visible,
                        Counters& counters) {
  const uint64_t links = uint64_t{ends.transmitter_count} * ends.receiver_count;
  const uint64_t places = uint64_t{visible.count} * (twins_ ? 2 : 1);
  if (links >= 0xFFFFFFFFu || places > 0x7FFFFFFFu)
    throw RuntimeError(fmt::format(
        "{} links with {} paths are more than a frame can have: give it fewer transmitters, receivers, cells "
        "of grids or vehicles with antennas",
        links, places));
  rows_.places = static_cast<uint32_t>(places);
  if (places == 0) return 0;
  if (places > keys_.size()) reserve(places + places / 4);
  arguments_ = {.row_count = rows_.places,
                .visible_counter = visible.counter,
                .max_depth = visible.max_depth,
                .receiver_count = ends.receiver_count,
                .groups = ends.receiver_capacity / 16,
                .twins = twins_,
                .length_bits = std::min(most_length_bits, 32u - static_cast<uint32_t>(std::bit_width(links)))};
  row_keys_({places, local_}, Stage::distinct,
            calls::distinct::row_keys{.solved = visible.headers,
                                      .vertices = visible.vertices,
                                      .steps = visible.sequences,
                                      .transmitters = ends.transmitters,
                                      .receivers = ends.receivers,
                                      .receiver_of = receiver_of_,
                                      .transmitter_of = transmitter_of_,
                                      .links = ends.links,
                                      .own = own,
                                      .keys = keys_,
                                      .lengths = lengths_,
                                      .counters = counters.buffer(),
                                      .args = arguments_});
  return rows_.places;
}

void Distinct::place(const DeviceScene& scene, const gpu::Buffer<wt_wedge>* wedges, const RadioEnds& ends,
                     const SolvedList& visible, Counters& counters) {
  mark_rows_({rows_.places, local_}, Stage::distinct,
             calls::distinct::mark_rows{.solved = visible.headers,
                                        .vertices = visible.vertices,
                                        .steps = visible.sequences,
                                        .transmitters = ends.transmitters,
                                        .receivers = ends.receivers,
                                        .receiver_of = receiver_of_,
                                        .transmitter_of = transmitter_of_,
                                        .surfaces = scene.exact_surfaces,
                                        .wedges = wedges,
                                        .keys = keys_,
                                        .order = order_,
                                        .lengths = lengths_,
                                        .stays = stays_,
                                        .quarters = quarters_,
                                        .counters = counters.buffer(),
                                        .args = arguments_});
  order_rows_({rows_.places, local_}, Stage::distinct,
              calls::distinct::order_rows{.solved = visible.headers,
                                          .vertices = visible.vertices,
                                          .steps = visible.sequences,
                                          .transmitters = ends.transmitters,
                                          .receivers = ends.receivers,
                                          .receiver_of = receiver_of_,
                                          .transmitter_of = transmitter_of_,
                                          .keys = keys_,
                                          .order = order_,
                                          .lengths = lengths_,
                                          .stays = stays_,
                                          .quarters = quarters_,
                                          .rows = rows_.rows,
                                          .delays = rows_.delays,
                                          .counts = rows_.counts,
                                          .row_quarters = rows_.quarters,
                                          .args = arguments_});
}

std::map<Link, uint32_t> Distinct::left_out() {
  const std::vector<uint8_t> stays = stays_.read(0, rows_.places, Stage::distinct);
  const std::vector<uint32_t> keys = keys_.read(0, rows_.places, Stage::distinct);
  std::map<Link, uint32_t> out;
  for (size_t place = 0; place < stays.size(); ++place) {
    const uint32_t link = static_cast<uint32_t>(uint64_t{keys[place]} >> arguments_.length_bits);
    if (stays[place] == WT_ROW_IS_NEAR) ++out[{link / arguments_.receiver_count, link % arguments_.receiver_count}];
  }
  return out;
}

}  // namespace wavetracer
