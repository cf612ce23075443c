// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/link_sums.cl.
// Links with waves have many rows each, those of maps without diffraction few. So the former have a group of work-items
// each on GPUs, the latter one work-item.
#include "passes/link_sums.hpp"

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/read_room.hpp"
#include "passes/upload.hpp"

namespace wavetracer {
namespace {

constexpr size_t slots_of_row = WT_MOST_GROUPS;

uint32_t lanes_of(const gpu::DeviceInfo& device, bool waves) { return waves ? path_tuning_of(device).sum_lanes : 1; }

}  // namespace

LinkSums::LinkSums(gpu::Context& context, double frequency_hz, Ports ports, bool waves)
    : LinkSums(context, frequency_hz, ports, waves, lanes_of(context.info(), waves)) {}

LinkSums::LinkSums(gpu::Context& context, double frequency_hz, Ports ports, bool waves, uint32_t lanes)
    : context_(context),
      lanes_(lanes),
      kernel_(context, {{"WT_LANES", std::to_string(lanes) + "u"}}),
      group_(lanes > 1 ? lanes : tuning_of(context.info()).exact.group),
      arguments_{.frequency_hz = frequency_hz,
                 .link_count = 0,
                 .row_capacity = 0,
                 .values = ports.tx * ports.rx > 1 ? 4u : 1u,
                 .grouped = waves ? 1u : 0u} {}

void LinkSums::operator()(const SummedRows& of, std::span<const Link> links, Counters& counters) {
  arguments_.link_count = static_cast<uint32_t>(links.size());
  if (links.empty()) return;
  std::vector<uint32_t> words;
  words.reserve(2 * links.size());
  for (const Link& link : links) words.insert(words.end(), {link.tx, link.rx});
  upload_changed(context_, links_, link_words_, std::move(words), "links of sums");
  if (out_.size() < links.size())
    out_ = context_.buffer<device::wt_link_sum>(links.size(), {"sums of links", advice::links});
  const size_t rows = arguments_.grouped ? std::max(of.most, 1u) : 0;
  if (fields_.size() < arguments_.values * 2 * rows) {
    const auto room = [](const char* name) { return gpu::BufferName{name, advice::links}; };
    fields_ = context_.buffer<double>(2 * arguments_.values * rows, room("fields of rows"));
    entries_ = context_.buffer<uint64_t>(slots_of_row * rows, room("waves of rows"));
    keys_ = context_.buffer<uint64_t>(slots_of_row * rows, room("waves of links"));
    sums_ = context_.buffer<double>(2 * arguments_.values * slots_of_row * rows, room("fields of waves"));
  }
  const auto of_waves = [&]<class T>(const gpu::Buffer<T>& buffer) { return arguments_.grouped ? &buffer : nullptr; };
  arguments_.row_capacity = static_cast<uint32_t>(of.rows.size());
  kernel_({links.size() * lanes_, group_}, Stage::link_sums,
          calls::link_sums::link_sums{.links = links_,
                                      .rows = of.rows,
                                      .waves = of.waves,
                                      .shared = of.shared,
                                      .entries = of_waves(entries_),
                                      .fields = of_waves(fields_),
                                      .keys = of_waves(keys_),
                                      .sums = of_waves(sums_),
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
