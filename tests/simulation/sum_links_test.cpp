// SPDX-License-Identifier: Apache-2.0
// Simulation::sum_links: the sums of links that the device makes are the figures of the paths that it otherwise gives,
// for all kinds of paths, ports, links both ways, and batches of receivers.
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "radio/links.hpp"
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Both {
  FrameResult paths, sums;
};

Both both(const Config& config) {
  Simulation simulation(config, "");
  Both out;
  out.paths = simulation.run_frame(0);
  simulation.forget();
  simulation.sum_links(true);
  out.sums = simulation.run_frame(0);
  return out;
}

bool near(double a, double b, double tolerance) {
  return std::isfinite(b) ? std::abs(a - b) <= tolerance * std::max(1.0, std::abs(b))
         : std::isnan(b)  ? std::isnan(a)
                          : a == b;
}

void check_figures(const FrameResult& paths, const FrameResult& sums, double carrier_hz) {
  REQUIRE(sums.summed);
  CHECK(sums.paths.size() == 0);
  CHECK_FALSE(paths.summed);
  const std::vector<LinkFigures> wanted = link_figures(paths.paths, 0, paths.world.links, carrier_hz);
  const std::vector<LinkFigures>& found = sums.summed->links;
  REQUIRE(found.size() == wanted.size());
  for (size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    const LinkFigures &a = found[i], &b = wanted[i];
    CHECK((a.tx == b.tx && a.rx == b.rx && a.paths == b.paths && a.los == b.los));
    CHECK(near(a.path_gain_db, b.path_gain_db, 1e-12));
    CHECK(near(a.sum_of_powers_db, b.sum_of_powers_db, 1e-12));
    CHECK(near(a.narrowband_gain_db, b.narrowband_gain_db, 1e-9));  // fields may cancel
    CHECK(near(a.mean_delay_s * 1e6, b.mean_delay_s * 1e6, 1e-12));
    CHECK(near(a.rms_delay_spread_s * 1e6, b.rms_delay_spread_s * 1e6, 1e-9));
    CHECK(near(a.doppler_spread_hz, b.doppler_spread_hz, 1e-9));
    CHECK(near(a.k_factor, b.k_factor, 1e-9));
    CHECK(near(a.missed_power_share, b.missed_power_share, 1e-9));
  }
}

void check(const Both& frames, double carrier_hz) {
  check_figures(frames.paths, frames.sums, carrier_hz);
  CHECK(frames.sums.counts.paths == frames.paths.counts.paths);
  CHECK(frames.sums.missed.paths == frames.paths.missed.paths);
  CHECK(near(frames.sums.missed.power, frames.paths.missed.power, 1e-12));
  CHECK(frames.sums.warnings == frames.paths.warnings);
}

}  // namespace

TEST_CASE("sums of links are the figures of their paths: reflections, edges, rays from edges, scattering") {
  const SceneFile file(two_boxes());
  Config config = map_over_boxes(file, 20000, 3, 3);
  config.trace.diffraction = false;
  check(both(config), config.radio.frequency_hz);
  config.trace.diffraction = true;
  const Both edges = both(config);
  check(edges, config.radio.frequency_hz);
  CHECK(edges.sums.summed->kinds[3] > 1000);
  config.trace.edge_rays = 300;
  check(both(config), config.radio.frequency_hz);
  config.trace.edge_rays = 0;
  config.trace.diffraction = false;
  config.trace.scattering = true;
  for (MaterialConfig& material : config.materials) material.scattering = 0.4;
  check(both(config), config.radio.frequency_hz);
}

TEST_CASE("sums of two ports, and of ends that move and send and receive") {
  const SceneFile file(two_boxes());
  Config config = map_over_boxes(file, 20000, 3, 2);
  config.trace.diffraction = true;
  for (RadioEnd& end : config.transmitters) end.polarization = "VH", end.velocity_m_s = {10, 3, 0};
  config.receiver_grids[0].polarization = "cross";
  RadioEnd station = config.transmitters[0];
  station.name = "station";
  station.position_m[0] += 3;
  config.stations = {station};
  const Both frames = both(config);
  check(frames, config.radio.frequency_hz);
  CHECK(frames.paths.paths.rx_ports == 2);
}

TEST_CASE("sums in batches of receivers are those of the whole frame, and rays are launched once") {
  const SceneFile file(two_boxes());
  for (const bool diffraction : {false, true}) {
    CAPTURE(diffraction);
    Config config = map_over_boxes(file, 20000, 3, 3);
    config.trace.diffraction = diffraction;
    config.trace.edge_rays = diffraction ? 100 : 0;
    const Both whole = both(config);
    for (const uint32_t batch : {9u, 60u}) {
      CAPTURE(batch);
      config.trace.batch_receivers = batch;
      Simulation simulation(config, "");
      simulation.sum_links(true);
      for (int times = 0; times < 2; ++times) {
        const FrameResult cut = simulation.run_frame(0);
        check_figures(whole.paths, cut, config.radio.frequency_hz);
        CHECK(cut.counts.rays == whole.paths.counts.rays);
        CHECK(cut.counts.paths == whole.paths.counts.paths);
        CHECK(cut.missed.paths == whole.paths.missed.paths);
        CHECK(cut.world.receivers.size() == whole.paths.world.receivers.size());
        CHECK(cut.world.links == whole.paths.world.links);
      }
      simulation.sum_links(false);  // then frames without diffraction are not cut
      CHECK(simulation.run_frame(0).paths.size() == whole.paths.paths.size());
    }
  }
}

// The figures of links with their bits, so that NaN is equal to itself.
std::vector<std::vector<uint64_t>> bits_of(const std::vector<LinkFigures>& links) {
  std::vector<std::vector<uint64_t>> out;
  for (const LinkFigures& link : links) {
    std::vector<uint64_t>& row = out.emplace_back();
    row = {link.frame, link.tx, link.rx, link.paths, link.los};
    for (const double value : {link.path_gain_db, link.sum_of_powers_db, link.narrowband_gain_db, link.mean_delay_s,
                               link.rms_delay_spread_s, link.doppler_spread_hz, link.k_factor, link.missed_power_share})
      row.push_back(std::bit_cast<uint64_t>(value));
  }
  return out;
}

TEST_CASE("sums of several transmitters in batches have the bits of the whole frame, in memory that is given back") {
  const SceneFile file(two_boxes());
  Config config = map_over_boxes(file, 20000, 3, 3);
  config.trace.diffraction = false;
  std::vector<std::vector<uint64_t>> whole;
  for (const std::optional<uint32_t> batch : {std::optional<uint32_t>(), {1u}, {7u}, {50u}}) {
    CAPTURE(batch.value_or(0));
    config.trace.batch_receivers = batch;
    Simulation simulation(config, "");
    simulation.sum_links(true);
    const LinkFigures* room = nullptr;
    for (int times = 0; times < 3; ++times) {
      FrameResult frame = simulation.run_frame(0);
      REQUIRE(frame.world.transmitters.size() == 3);
      REQUIRE(frame.summed);
      if (whole.empty()) whole = bits_of(frame.summed->links);
      CHECK(bits_of(frame.summed->links) == whole);
      if (room != nullptr) CHECK(frame.summed->links.data() == room);
      room = frame.summed->links.data();
      simulation.give_back(frame);
      CHECK_FALSE(frame.summed);
    }
  }
  CHECK(whole.size() > 300);
}

TEST_CASE("batches share rays where stations have links both ways, in blocks of transmitters, too") {
  const SceneFile file(two_boxes());
  Config config = map_over_boxes(file, 20000, 3, 3);
  config.receiver_grids.clear();
  config.receivers.clear();
  for (int i = 0; i < 3; ++i) {
    RadioEnd& station = config.stations.emplace_back(config.stations[0]);
    station.name = "station " + std::to_string(i);
    station.position_m[0] += 2.5 * (i + 1);
    station.position_m[1] += 3.5 * i;
  }
  for (const bool diffraction : {false, true}) {
    CAPTURE(diffraction);
    config.trace.diffraction = diffraction;
    config.trace.batch_receivers = {};
    const Both whole = both(config);
    CHECK(whole.paths.paths.size() > 30);
    config.trace.batch_receivers = 1;
    Simulation simulation(config, "");
    simulation.sum_links(true);
    check_figures(whole.paths, simulation.run_frame(0), config.radio.frequency_hz);
    const uint64_t first = simulation.run_block(0, {0, 2}).counts.paths;
    CHECK(first > 0);
    CHECK(first + simulation.run_block(0, {2, no_end}).counts.paths == whole.paths.paths.size());
  }
}

TEST_CASE("paths come again when sums are no longer asked for, and links without a path are explained alike") {
  const SceneFile file(two_boxes());
  Config config = map_over_boxes(file, 5000, 2, 2);
  config.trace.diffraction = false;
  Simulation simulation(config, "");
  simulation.sum_links(true);
  const FrameResult sums = simulation.run_frame(0);
  simulation.sum_links(false);
  simulation.forget();
  const FrameResult paths = simulation.run_frame(0);
  CHECK_FALSE(paths.summed);
  CHECK(paths.paths.size() == sums.counts.paths);
  const MissingLinks a = simulation.explain_missing(sums), b = simulation.explain_missing(paths);
  CHECK(a.in_grids == b.in_grids);
  CHECK(a.in_grids > 0);
  CHECK(a.why_in_grids == b.why_in_grids);
}
