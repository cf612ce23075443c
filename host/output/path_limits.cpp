// SPDX-License-Identifier: Apache-2.0
// Handles the links of a frame one after the other; of equally strong paths the earlier one is written.
#include "output/path_limits.hpp"
#include <algorithm>
#include <numeric>
#include <unordered_map>
#include "radio/path_power.hpp"

namespace wavetracer {
namespace {

// Marks the written paths among the rows first to end - 1, which belong to one link and frame.
void mark_link(const Paths& paths, const OutputConfig& output, size_t first, size_t end,
               std::vector<uint8_t>& written) {
  std::vector<size_t> strongest_first(end - first);
  std::iota(strongest_first.begin(), strongest_first.end(), first);
  std::ranges::stable_sort(strongest_first, [&](size_t a, size_t b) { return paths.gain_db[a] > paths.gain_db[b]; });
  if (output.max_paths_per_link && strongest_first.size() > *output.max_paths_per_link)
    strongest_first.resize(*output.max_paths_per_link);
  const double strongest_db = paths.gain_db[strongest_first.front()];
  for (const size_t row : strongest_first) {
    const double gain_db = paths.gain_db[row];
    written[row] = (!output.min_gain_db || gain_db >= *output.min_gain_db) &&
                   (!output.dynamic_range_db || gain_db >= strongest_db - *output.dynamic_range_db);
  }
}

template <class Value>
std::vector<Value> selected(const std::vector<Value>& values, std::span<const uint8_t> written) {
  std::vector<Value> out;
  for (size_t row = 0; row < values.size(); ++row)
    if (written[row]) out.push_back(values[row]);
  return out;
}

void append_vertices(const Paths& from, size_t row, Paths& to) {
  const auto append = [&](const auto& values, auto& out) {
    out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(from.vertex_offset[row]),
               values.begin() + static_cast<std::ptrdiff_t>(from.vertex_offset[row + 1]));
  };
  append(from.vertex_position_m, to.vertex_position_m);
  append(from.vertex_interaction, to.vertex_interaction);
  append(from.vertex_surface, to.vertex_surface);
  append(from.vertex_instance, to.vertex_instance);
  to.vertex_offset.push_back(to.vertex_position_m.size());
}

// Renumbers the groups of each link for the rows that are left.
void number_groups(Paths& paths) {
  for (size_t first = 0, end = 0; first < paths.group.size(); first = end) {
    end = end_of_link(paths, first);
    std::unordered_map<uint32_t, uint32_t> numbers;
    for (size_t row = first; row < end; ++row)
      for (uint32_t& group : paths.group[row])
        if (group != no_group) group = numbers.try_emplace(group, static_cast<uint32_t>(numbers.size())).first->second;
  }
}

}  // namespace

bool limits_paths(const OutputConfig& output) {
  return !output.paths || output.min_gain_db || output.dynamic_range_db || output.max_paths_per_link;
}

std::vector<uint8_t> written_rows(const Paths& paths, const OutputConfig& output) {
  std::vector<uint8_t> written(paths.size(), !limits_paths(output));
  if (!limits_paths(output) || !output.paths) return written;
  for (size_t first = 0, end = 0; first < paths.size(); first = end) {
    end = end_of_link(paths, first);
    mark_link(paths, output, first, end, written);
  }
  return written;
}

Paths select_rows(const Paths& paths, std::span<const uint8_t> written) {
  Paths out;
  out.rx_ports = paths.rx_ports;
  out.tx_ports = paths.tx_ports;
  for (const auto column : {&Paths::frame, &Paths::tx, &Paths::rx, &Paths::depth})
    out.*column = selected(paths.*column, written);
  for (const auto column : {&Paths::delay_s, &Paths::gain_db, &Paths::aod_theta_rad, &Paths::aod_phi_rad,
                            &Paths::aoa_theta_rad, &Paths::aoa_phi_rad, &Paths::doppler_hz})
    out.*column = selected(paths.*column, written);
  out.a = selected(paths.a, written);
  out.quarters = selected(paths.quarters, written);
  out.target = selected(paths.target, written);
  out.group = selected(paths.group, written);
  out.group_weight = selected(paths.group_weight, written);
  out.lifetime_m = selected(paths.lifetime_m, written);
  number_groups(out);
  for (size_t row = 0; row < paths.size(); ++row)
    if (written[row]) append_vertices(paths, row, out);
  return out;
}

std::vector<CarrierFields> select_rows(const std::vector<CarrierFields>& carriers, std::span<const uint8_t> written) {
  std::vector<CarrierFields> out;
  for (const CarrierFields& fields : carriers)
    out.push_back({fields.frequency_hz, selected(fields.a, written), selected(fields.gain_db, written),
                   selected(fields.doppler_hz, written)});
  return out;
}

LeftOutPaths left_out(const FrameResult& frame, std::span<const uint8_t> written) {
  if (frame.summed) return {frame.counts.paths, frame.summed->power, frame.summed->power};
  return left_out(frame.paths, written, 0, frame.paths.size());
}

LeftOutPaths left_out(const Paths& paths, std::span<const uint8_t> written, size_t first, size_t end) {
  LeftOutPaths out;
  for (size_t row = first; row < end; ++row) {
    const double power = power_of(paths, row);
    out.all += power;
    if (written[row]) continue;
    ++out.paths;
    out.power += power;
  }
  return out;
}

}  // namespace wavetracer
