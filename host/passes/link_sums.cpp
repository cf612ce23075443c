// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/link_sums.cl.
// One link per work-item. The table of waves has four slots for each row, so that no table can be full.
#include "passes/link_sums.hpp"

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/read_room.hpp"
#include "passes/upload.hpp"

namespace wavetracer {
namespace {

constexpr size_t slots_of_row = 4;

}  // namespace

LinkSums::LinkSums(gpu::Context& context, double frequency_hz, Ports ports)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).exact),
      arguments_{.frequency_hz = frequency_hz,
                 .link_count = 0,
                 .row_capacity = 0,
                 .values = ports.tx * ports.rx > 1 ? 4u : 1u,
                 .grouped = 0} {}

void LinkSums::operator()(const SummedRows& of, std::span<const Link> links, Counters& counters) {
  arguments_.link_count = static_cast<uint32_t>(links.size());
  if (links.empty()) return;
  std::vector<uint32_t> words;
  words.reserve(2 * links.size());
  for (const Link& link : links) words.insert(words.end(), {link.tx, link.rx});
  upload_changed(context_, links_, link_words_, std::move(words), "links of sums");
  if (out_.size() < links.size())
    out_ = context_.buffer<device::wt_link_sum>(links.size(), {"sums of links", advice::links});
  const size_t slots = slots_of_row * std::max(of.waves ? of.most : 0u, 1u);
  if (keys_.size() < slots) {
    keys_ = context_.buffer<uint64_t>(slots, {"waves of links", advice::links});
    sums_ = context_.buffer<double>(2 * arguments_.values * slots, {"fields of waves", advice::links});
  }
  if (of.waves) {
    context_.fill(keys_, uint64_t{0}, Stage::link_sums);
    context_.fill(sums_, 0.0, Stage::link_sums);
  }
  arguments_.row_capacity = static_cast<uint32_t>(of.rows.size());
  arguments_.grouped = of.waves ? 1 : 0;
  kernel_(work_.range(links.size()), Stage::link_sums,
          calls::link_sums::link_sums{.links = links_,
                                      .rows = of.rows,
                                      .vertices = of.vertices,
                                      .waves = of.waves,
                                      .shared = of.shared,
                                      .keys = keys_,
                                      .sums = sums_,
                                      .out = out_,
                                      .counters = counters.buffer(),
                                      .args = arguments_});
}

std::span<const device::wt_link_sum> LinkSums::read() {
  if (arguments_.link_count == 0) return {};
  make_host_room(context_, out_, host_, "sums of links");
  return out_.read(0, arguments_.link_count, host_, Stage::link_sums);
}

}  // namespace wavetracer
