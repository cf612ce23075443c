// SPDX-License-Identifier: Apache-2.0
// A run of transmitters and one grid "g" of cells of 10 m, whose paths a test adds one by one.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "output/sample_run.hpp"
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "results/saved_run.hpp"
#include "temporary_folder.hpp"

namespace wavetracer::test {

constexpr double made_step_m = 10, made_height_m = 1.5, made_carrier_hz = 5.9e9;

struct MadeGrid {
  uint32_t columns, rows;
  SampleRun sample;
  FrameResult frame;
  TemporaryFolder folder;

  // The middle of cell 0,0 is at 5, 5.
  MadeGrid(uint32_t of_columns, uint32_t of_rows, const std::vector<glm::dvec3>& transmitters)
      : columns(of_columns), rows(of_rows) {
    Config& config = sample.config;
    config.radio.frequency_hz = made_carrier_hz;
    config.transmitters.clear();
    sample.instances.clear();
    sample.models.clear();
    sample.scene.origin_m = {0, 0, 0};
    config.receivers = {{.name = "alone"}};
    for (size_t i = 0; i < transmitters.size(); ++i)
      config.transmitters.push_back(
          {.name = fmt::format("t{}", i), .position_m = {transmitters[i].x, transmitters[i].y, transmitters[i].z}});
    for (uint32_t k = 0; k < columns * rows; ++k)
      config.receivers.push_back(
          {.name = fmt::format("g/{},{}", k % columns, k / columns), .position_m = {at(k).x, at(k).y, at(k).z}});
    for (const RadioEnd& end : config.transmitters)
      frame.world.transmitters.push_back({.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]}});
    for (const RadioEnd& end : config.receivers)
      frame.world.receivers.push_back({.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]}});
    for (uint32_t tx = 0; tx < transmitters.size(); ++tx)
      for (uint32_t rx = 0; rx < config.receivers.size(); ++rx) frame.world.links.push_back({tx, rx});
  }

  glm::dvec3 at(uint32_t cell) const {
    return {made_step_m * (cell % columns + 0.5), made_step_m * (cell / columns + 0.5), made_height_m};
  }

  // Paths must be added sorted by transmitter, then cell. depth: 0 is a direct path, 1 a reflection.
  void add(uint32_t tx, uint32_t cell, std::complex<double> a, double delay_s, uint32_t depth) {
    Paths& p = frame.paths;
    p.frame.push_back(0);
    p.tx.push_back(tx);
    p.rx.push_back(cell + 1);
    p.depth.push_back(depth);
    p.delay_s.push_back(delay_s);
    p.gain_db.push_back(10 * std::log10(std::norm(a)));
    p.a.push_back({{a, {0, 0}, {0, 0}, {0, 0}}});
    for (auto* column : {&p.aod_theta_rad, &p.aod_phi_rad, &p.aoa_theta_rad, &p.aoa_phi_rad, &p.doppler_hz})
      column->push_back(0);
    for (uint32_t k = 0; k < depth; ++k) {
      p.vertex_position_m.push_back({1, 2, 3});
      p.vertex_interaction.push_back(1);
      p.vertex_surface.push_back(0);
      p.vertex_instance.push_back(no_instance);
    }
    p.vertex_offset.push_back(p.vertex_position_m.size());
  }

  SavedRun written() {
    write_outputs(folder.path() / "run", sample.run(), std::span(&frame, 1));
    return SavedRun(folder.path() / "run");
  }
};

// The links of the first frame, as maps take them.
inline std::vector<LinkRow> links_of(const SavedRun& run) {
  return link_rows(run.frame(0), link_table(run), run.first_link(0), run.frequency_hz());
}

}  // namespace wavetracer::test
