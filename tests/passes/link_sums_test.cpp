// SPDX-License-Identifier: Apache-2.0
// link_sums: sums over the paths of each link, against the figures that the host makes of the same rows and waves.
#include "passes/link_sums.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "passes/on_device.hpp"
#include "passes/triangles.hpp"
#include "radio/group_numbers.hpp"
#include "radio/links.hpp"
#include "radio/path_columns.hpp"
#include "radio/summed_paths.hpp"
#include "wavetracer/interaction_kinds.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double carrier_hz = 5.9e9;

struct Rows {
  std::vector<device::wt_path_row> rows;
  std::vector<device::wt_vertex_row> vertices;
  std::vector<device::wt_path_wave> waves;
  std::vector<device::wt_path_waves> shared;
};

// Adds the vertices of a path; the first path of a link has none.
void add_vertices(Rows& rows, device::wt_path_row& row, uint32_t depth, Random& random) {
  constexpr uint32_t codes[] = {reflection, scattering, transmission, diffraction};
  for (uint32_t k = 0; k < depth; ++k) {
    device::wt_vertex_row vertex{};
    vertex.interaction = codes[random.below(4)];
    rows.vertices.push_back(vertex);
    row.quarters |= vertex.interaction << WT_ROW_MET_SHIFT;
  }
}

// Adds the waves of a path: one of few keys, so that paths share them, or up to four with weights whose squares add up
// to 1.
void add_waves(Rows& rows, const device::wt_path_row& row, Random& random) {
  const auto key = [&] { return uint64_t{random.below(7) + 1} * 0x9E3779B97F4A7C15ull; };
  device::wt_path_wave own{key(), WT_ONE_WAVE, random.below(2), row.tx, row.rx};
  if (random() < 0.4) {
    device::wt_path_waves all{};
    all.count = 1 + random.below(4);
    all.bends = own.bends = 1;
    for (uint32_t i = 0; i < all.count; ++i) {
      do all.keys[i] = key();
      while (std::find(all.keys, all.keys + i, all.keys[i]) != all.keys + i);
      all.weights[i] = random.between(0.1, 1);
    }
    const double squares = std::inner_product(all.weights, all.weights + all.count, all.weights, 0.0);
    for (uint32_t i = 0; i < all.count; ++i) all.weights[i] /= std::sqrt(squares);
    own.key = all.keys[0];
    own.shared = static_cast<uint32_t>(rows.shared.size());
    rows.shared.push_back(all);
  }
  rows.waves.push_back(own);
}

// Makes rows of some of the links, in their order. ports: receiver's port 2 r + transmitter's port t.
Rows random_rows(const std::vector<Link>& links, Ports ports, uint32_t most, Random& random) {
  Rows out;
  for (const Link& link : links) {
    const uint32_t count = random() < 0.2 ? 0 : 1 + random.below(most);
    for (uint32_t i = 0; i < count; ++i) {
      device::wt_path_row row{};
      row.tx = link.tx;
      row.rx = link.rx;
      row.first_vertex = static_cast<uint32_t>(out.vertices.size());
      row.delay_s = random.between(1e-7, 3e-6);
      row.doppler_hz = random.between(-900, 900);
      row.quarters = random.below(16) | (random() < 0.1 ? WT_ROW_NEAR_EDGE : 0u);
      const double size = std::pow(10.0, random.between(-9, -4));
      for (uint32_t r = 0; r < ports.rx; ++r)
        for (uint32_t t = 0; t < ports.tx; ++t)
          for (uint32_t part = 0; part < 2; ++part) row.a[2 * (2 * r + t) + part] = size * random.between(-1, 1);
      add_vertices(out, row, i == 0 && random() < 0.5 ? 0 : 1 + random.below(4), random);
      add_waves(out, row, random);
      out.rows.push_back(row);
    }
  }
  return out;
}

std::vector<device::wt_link_sum> on_device(const Rows& of, const std::vector<Link>& links, Ports ports, bool grouped,
                                           uint32_t lanes) {
  const auto count = static_cast<uint32_t>(of.rows.size());
  const auto buffer = [](const auto& records, const char* name) {
    auto filled = records;
    filled.resize(std::max<size_t>(filled.size(), 1));
    return context().buffer(filled, name);
  };
  const auto rows = buffer(of.rows, "rows");
  const auto waves = buffer(of.waves, "waves");
  const auto shared = buffer(of.shared, "waves of several");
  Counters counters(context());
  counters.zero();
  counters.restart(&wt_counters::rows, count, Stage::fields);
  LinkSums pass(context(), carrier_hz, ports, grouped, lanes);
  pass({rows, grouped ? &waves : nullptr, grouped ? &shared : nullptr, count}, links, counters);
  const auto sums = pass.read();
  return {sums.begin(), sums.end()};
}

// The host's figures of the same rows.
Paths paths_of(const Rows& of, Ports ports, bool grouped) {
  Paths out = columns_of({of.rows, of.vertices, 0}, ports);
  if (!grouped) return out;
  GroupColumns groups = number_groups(of.waves, of.shared, {});
  out.group = std::move(groups.group);
  out.group_weight = std::move(groups.weight);
  return out;
}

void check_near(double found, double wanted, double tolerance) {
  if (std::isfinite(wanted))
    CHECK(std::abs(found - wanted) <= tolerance * std::max(1.0, std::abs(wanted)));
  else
    CHECK((std::isnan(wanted) ? std::isnan(found) : found == wanted));
}

void check(const Rows& rows, const std::vector<Link>& links, Ports ports, bool grouped) {
  const std::vector<device::wt_link_sum> sums = on_device(rows, links, ports, grouped, 1);
  REQUIRE(sums.size() == links.size());
  const std::vector<device::wt_link_sum> shared = on_device(rows, links, ports, grouped, 32);
  CHECK(std::memcmp(sums.data(), shared.data(), sums.size() * sizeof sums[0]) == 0);
  const SummedPaths found = summed_paths(sums, 0, links, true);
  const Paths paths = paths_of(rows, ports, grouped);
  const std::vector<LinkFigures> wanted = link_figures(paths, 0, links, carrier_hz);
  for (size_t i = 0; i < links.size(); ++i) {
    CAPTURE(i);
    const LinkFigures &a = found.links[i], &b = wanted[i];
    CHECK((a.tx == b.tx && a.rx == b.rx && a.paths == b.paths && a.los == b.los));
    check_near(a.path_gain_db, b.path_gain_db, 1e-12);
    check_near(a.sum_of_powers_db, b.sum_of_powers_db, 1e-12);
    check_near(a.narrowband_gain_db, b.narrowband_gain_db, 1e-10);  // fields may cancel
    check_near(a.mean_delay_s * 1e6, b.mean_delay_s * 1e6, 1e-12);
    check_near(a.rms_delay_spread_s * 1e6, b.rms_delay_spread_s * 1e6, 1e-12);
    check_near(a.doppler_spread_hz, b.doppler_spread_hz, 1e-12);
    check_near(a.k_factor, b.k_factor, 1e-10);
    check_near(a.missed_power_share, b.missed_power_share, 1e-10);
  }
  const SumCounts counts = sum_counts(sums);
  const MissedCounts missed = missed_counts(paths, 0, paths.size());
  CHECK(counts.missed.paths == missed.paths);
  check_near(counts.missed.amplitude, missed.amplitude, 1e-12);
  check_near(counts.missed.power, missed.power, 1e-12);
  CHECK(counts.near_edges == std::ranges::count_if(rows.rows, [](const device::wt_path_row& row) {
          return (row.quarters & WT_ROW_NEAR_EDGE) != 0;
        }));
  std::array<uint64_t, 6> kinds{};
  for (size_t row = 0; row < paths.size(); ++row) {
    size_t kind = 0;
    for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
      for (size_t i = 0; i < interaction_kinds.size(); ++i)
        if (paths.vertex_interaction[k] == interaction_kinds[i].code) kind = std::max(kind, i + 1);
    ++kinds[kind];
  }
  CHECK(found.kinds == kinds);
}

std::vector<Link> all_links(uint32_t transmitters, uint32_t receivers) {
  std::vector<Link> out;
  for (uint32_t tx = 0; tx < transmitters; ++tx)
    for (uint32_t rx = 0; rx < receivers; ++rx) out.push_back({tx, rx});
  return out;
}

}  // namespace

TEST_CASE("random rows: figures of links are those of the host, with and without waves, for one port and two") {
  Random random(5);
  const std::vector<Link> links = all_links(3, 70);
  for (const Ports ports : {Ports{1, 1}, Ports{2, 1}, Ports{2, 2}})
    for (const bool grouped : {false, true}) {
      CAPTURE(ports.tx);
      CAPTURE(ports.rx);
      CAPTURE(grouped);
      const Rows rows = random_rows(links, ports, 40, random);
      CHECK(rows.shared.size() > 100);
      check(rows, links, ports, grouped);
    }
}

TEST_CASE("links without any path, a frame without any, and a link of a thousand") {
  Random random(9);
  check({}, all_links(2, 5), {1, 1}, true);
  check(random_rows({{0, 3}}, {1, 1}, 1, random), all_links(1, 9), {1, 1}, true);
  for (int tries = 0; tries < 4; ++tries)
    check(random_rows({{1, 2}}, {2, 2}, 1000, random), all_links(3, 4), {2, 2}, true);
  CHECK(on_device({}, {}, {1, 1}, true, 1).empty());
}
