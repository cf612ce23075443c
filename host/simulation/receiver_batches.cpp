// SPDX-License-Identifier: Apache-2.0
// Rows of a transmitter are those of the batches in their order, since batches are ranges of receivers. All batches
// must be of one frame, with the same ends.
#include "simulation/receiver_batches.hpp"

#include <algorithm>

namespace wavetracer {
namespace {

constexpr uint32_t most_receivers = 8192;  // some 300 to 1500 sequences each, of about 350 bytes

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t first, size_t end) {
  if (!from.empty())
    to.insert(to.end(), from.begin() + static_cast<ptrdiff_t>(first), from.begin() + static_cast<ptrdiff_t>(end));
}

void append_rows(Paths& to, const Paths& from, size_t first, size_t end) {
  static_assert(sizeof(Paths) == 8 + 20 * sizeof(std::vector<int>), "append the column that is new here, too");
  for (auto column : {&Paths::frame, &Paths::tx, &Paths::rx, &Paths::depth})
    append(to.*column, from.*column, first, end);
  for (auto column : {&Paths::delay_s, &Paths::gain_db, &Paths::aod_theta_rad, &Paths::aod_phi_rad,
                      &Paths::aoa_theta_rad, &Paths::aoa_phi_rad, &Paths::doppler_hz})
    append(to.*column, from.*column, first, end);
  append(to.a, from.a, first, end);
  append(to.quarters, from.quarters, first, end);
  append(to.group, from.group, first, end);
  append(to.group_weight, from.group_weight, first, end);
  const uint64_t vertices = from.vertex_offset[first], start = to.vertex_offset.back();
  for (size_t row = first; row < end; ++row) to.vertex_offset.push_back(start + from.vertex_offset[row + 1] - vertices);
  const uint64_t last = from.vertex_offset[end];
  append(to.vertex_position_m, from.vertex_position_m, vertices, last);
  append(to.vertex_interaction, from.vertex_interaction, vertices, last);
  append(to.vertex_surface, from.vertex_surface, vertices, last);
  append(to.vertex_instance, from.vertex_instance, vertices, last);
}

// Visits the rows of a transmitter, batch after batch. take: adds rows first to end - 1 of a batch to the joined
// result.
template <class Take>
void take_by_transmitters(const std::vector<FrameResult>& batches, const Take& take) {
  std::vector<size_t> next(batches.size(), 0);  // next row of each batch
  for (uint32_t tx = 0; tx < batches.front().world.transmitters.size(); ++tx)
    for (size_t i = 0; i < batches.size(); ++i) {
      const std::vector<uint32_t>& column = batches[i].paths.tx;
      const size_t first = next[i];
      next[i] = static_cast<size_t>(std::upper_bound(column.begin(), column.end(), tx) - column.begin());
      take(batches[i], first, next[i]);
    }
}

Paths joined_paths(const std::vector<FrameResult>& batches) {
  Paths out;
  out.rx_ports = batches.front().paths.rx_ports;
  out.tx_ports = batches.front().paths.tx_ports;
  take_by_transmitters(
      batches, [&](const FrameResult& batch, size_t first, size_t end) { append_rows(out, batch.paths, first, end); });
  return out;
}

std::vector<CarrierFields> joined_carriers(const std::vector<FrameResult>& batches) {
  std::vector<CarrierFields> out(batches.front().carriers.size());
  for (size_t k = 0; k < out.size(); ++k) {
    out[k].frequency_hz = batches.front().carriers[k].frequency_hz;
    take_by_transmitters(batches, [&](const FrameResult& batch, size_t first, size_t end) {
      const CarrierFields& from = batch.carriers[k];
      append(out[k].a, from.a, first, end);
      append(out[k].gain_db, from.gain_db, first, end);
      append(out[k].doppler_hz, from.doppler_hz, first, end);
    });
  }
  return out;
}

void add_counts(FrameResult& to, const FrameResult& from) {
  for (auto count : {&FrameCounts::rays, &FrameCounts::segments, &FrameCounts::hits, &FrameCounts::sequences,
                     &FrameCounts::candidates, &FrameCounts::solved, &FrameCounts::paths, &FrameCounts::receptions})
    to.counts.*count += from.counts.*count;
  add_part(to.certificate, from.certificate);
  for (const auto& [stage, seconds] : from.seconds) to.seconds[stage] += seconds;
  for (const auto& [name, kernel] : from.kernels) {
    to.kernels[name].seconds += kernel.seconds;
    to.kernels[name].launches += kernel.launches;
    to.kernels[name].items += kernel.items;
  }
  to.segments_per_depth.resize(std::max(to.segments_per_depth.size(), from.segments_per_depth.size()));
  for (size_t i = 0; i < from.segments_per_depth.size(); ++i) to.segments_per_depth[i] += from.segments_per_depth[i];
  for (const std::string& warning : from.warnings)
    if (std::ranges::find(to.warnings, warning) == to.warnings.end()) to.warnings.push_back(warning);
}

}  // namespace

std::vector<ReceiverRange> receiver_batches(const TraceConfig& trace, uint32_t receiver_count, uint32_t most) {
  const uint32_t asked = trace.diffraction ? trace.batch_receivers.value_or(most_receivers) : no_end;
  const uint32_t batch = std::min(asked, most);
  if (receiver_count <= batch) return {{}};
  std::vector<ReceiverRange> out;
  for (uint32_t first = 0; first < receiver_count; first += std::min(batch, receiver_count - first))
    out.push_back({first, first + std::min(batch, receiver_count - first)});
  return out;
}

FrameResult joined_batches(std::vector<FrameResult> batches) {
  FrameResult out;
  out.frame = batches.front().frame;
  out.paths = joined_paths(batches);
  out.carriers = joined_carriers(batches);
  for (const FrameResult& batch : batches) add_counts(out, batch);
  const auto any = [&](uint64_t MissedCounts::*frames) {
    return std::ranges::any_of(batches, [&](const FrameResult& batch) { return batch.missed.*frames > 0; });
  };
  if (any(&MissedCounts::unknown)) {
    out.missed.unknown = 1;
    out.paths.quarters.clear();
  } else if (any(&MissedCounts::frames)) {
    out.missed = missed_counts(out.paths, 0, out.paths.size());
  }
  out.world = std::move(batches.front().world);
  for (size_t i = 1; i < batches.size(); ++i)
    append(out.world.links, batches[i].world.links, 0, batches[i].world.links.size());
  std::ranges::sort(out.world.links);
  return out;
}

}  // namespace wavetracer
