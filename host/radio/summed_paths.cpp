// SPDX-License-Identifier: Apache-2.0
// All cores take part.
#include "radio/summed_paths.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

double level_db(double power) { return 10 * std::log10(power); }

MissedCounts missed_of(const device::wt_link_sum& sum) {
  MissedCounts out;
  out.frames = 1;
  std::ranges::copy(sum.found, out.paths.begin());
  std::ranges::copy(sum.found_powers, out.powers.begin());
  out.amplitude = sum.amplitude;
  out.power = sum.power;
  return out;
}

// Adds the sums of blocks of links, each from an empty value on. The blocks do not depend on the number of cores.
template <class Value, class Add>
std::vector<Value> by_blocks(std::span<const device::wt_link_sum> sums, const Add& add) {
  constexpr size_t links_of_block = 4096;
  std::vector<Value> out((sums.size() + links_of_block - 1) / links_of_block);
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t block) {
    const size_t first = block * links_of_block, end = std::min(first + links_of_block, sums.size());
    for (size_t i = first; i < end; ++i) add(out[block], sums[i]);
  });
  return out;
}

LinkFigures figures_of(const device::wt_link_sum& sum, uint32_t frame, const Link& link, bool told) {
  LinkFigures out;
  out.frame = frame;
  out.tx = link.tx;
  out.rx = link.rx;
  out.paths = sum.paths;
  out.path_gain_db = level_db(sum.grouped);
  out.sum_of_powers_db = level_db(sum.power);
  out.narrowband_gain_db = level_db(sum.narrowband);
  const bool heard = sum.power > 0;
  out.mean_delay_s = heard ? sum.mean_delay_s : no_figure;
  out.rms_delay_spread_s = heard ? sum.rms_delay_s : no_figure;
  out.doppler_spread_hz = heard ? sum.rms_doppler_hz : no_figure;
  out.los = sum.kinds[0] > 0;
  const double others = std::accumulate(std::begin(sum.found_powers), std::end(sum.found_powers), 0.0);
  out.k_factor = sum.direct > 0 ? sum.direct / others : no_figure;
  out.missed_power_share = told && heard ? estimate_missed(missed_of(sum)).power_share.estimate : no_figure;
  return out;
}

}  // namespace

std::vector<LinkFigures> sized_figures(std::vector<LinkFigures> room, size_t links) {
  constexpr size_t page = 4096;
  if (room.capacity() < links) {
    room = std::vector<LinkFigures>();
    room.reserve(links);
    auto* const bytes = reinterpret_cast<volatile unsigned char*>(room.data());
    tbb::parallel_for(size_t{0}, links * sizeof(LinkFigures) / page, [&](size_t i) { bytes[i * page] = 0; });
  }
  room.resize(links);
  return room;
}

SummedPaths summed_paths(std::span<const device::wt_link_sum> sums, uint32_t frame, std::span<const Link> links,
                         bool told, std::vector<LinkFigures> room) {
  static_assert(std::tuple_size_v<decltype(SummedPaths::kinds)> == path_kinds.size());
  SummedPaths out;
  out.links = sized_figures(std::move(room), links.size());
  tbb::parallel_for(size_t{0}, links.size(),
                    [&](size_t i) { out.links[i] = figures_of(sums[i], frame, links[i], told); });
  for (const SummedPaths& part : by_blocks<SummedPaths>(sums, [](SummedPaths&to, const device::wt_link_sum&sum) {
         for (size_t kind = 0; kind < to.kinds.size(); ++kind) to.kinds[kind] += sum.kinds[kind];
         to.power += sum.power;
       })) {
    for (size_t kind = 0; kind < out.kinds.size(); ++kind) out.kinds[kind] += part.kinds[kind];
    out.power += part.power;
  }
  return out;
}

SumCounts sum_counts(std::span<const device::wt_link_sum> sums) {
  SumCounts out;
  out.missed.frames = 1;
  for (const SumCounts& part : by_blocks<SumCounts>(sums, [](SumCounts&to, const device::wt_link_sum&sum) {
         add_part(to.missed, missed_of(sum));
         to.near_edges += sum.near_edges;
       })) {
    add_part(out.missed, part.missed);
    out.near_edges += part.near_edges;
  }
  return out;
}

}  // namespace wavetracer
