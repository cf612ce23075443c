// SPDX-License-Identifier: Apache-2.0
// Vehicles drive along x, 5 m/s, in lanes of the street y = 0 of the generated city; paths bounce at made-up points.
// Lengths are those of the polylines, gains those of free space less 6 dB an interaction.
#include "viewer/made_runs.hpp"
#include <fmt/format.h>
#include <cmath>
#include <glm/geometric.hpp>
#include "radio/constants.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::test {
namespace {

constexpr double frequency_hz = 5.9e9;
const Interaction interactions[] = {reflection, diffraction, transmission, scattering};

glm::dvec3 vehicle_position(uint32_t vehicle, double time_s) {
  return {-60.0 + 12.0 * (vehicle % 10) + 5 * time_s, -4.5 + 3.0 * (vehicle / 10), 0};
}

// The k-th path has k % 4 interactions, the i-th of them of the kind (k + i) / 4.
void add_path(Paths& paths, uint32_t frame, const Link& link, const EndState& from, const EndState& to, uint32_t k) {
  const uint32_t order = k % 4;
  glm::dvec3 last = from.position_m, first_leg{0}, leg{0};
  double length_m = 0;
  const auto go_to = [&](const glm::dvec3& point) {
    leg = point - last;
    if (length_m == 0) first_leg = leg;
    length_m += glm::length(leg);
    last = point;
  };
  for (uint32_t i = 0; i < order; ++i) {
    const double share = (i + 1.0) / (order + 1.0), side = (k + i) % 2 ? 8.0 : -8.0;
    const glm::dvec3 between = from.position_m * (1 - share) + to.position_m * share;
    const glm::dvec3 point{between.x + 0.5 * k, side + 0.05 * k, 2.0 + 0.1 * k};
    go_to(point);
    paths.vertex_position_m.push_back(point);
    paths.vertex_interaction.push_back(interactions[(k + i) / 4 % 4]);
    paths.vertex_surface.push_back(k + i);
    paths.vertex_instance.push_back(no_instance);
  }
  go_to(to.position_m);
  const glm::dvec3 out = glm::normalize(first_leg), in = -glm::normalize(leg);
  const double loss_db = 20 * std::log10(4 * std::acos(-1.0) * length_m * frequency_hz / speed_of_light_m_s);
  paths.frame.push_back(frame);
  paths.tx.push_back(link.tx);
  paths.rx.push_back(link.rx);
  paths.depth.push_back(order);
  paths.delay_s.push_back(length_m / speed_of_light_m_s);
  paths.gain_db.push_back(-loss_db - 6.0 * order);
  paths.a.push_back({std::polar(std::pow(10.0, paths.gain_db.back() / 20), 0.1 * k)});
  paths.aod_theta_rad.push_back(std::acos(out.z));
  paths.aod_phi_rad.push_back(std::atan2(out.y, out.x));
  paths.aoa_theta_rad.push_back(std::acos(in.z));
  paths.aoa_phi_rad.push_back(std::atan2(in.y, in.x));
  paths.doppler_hz.push_back(10.0 * k - 7.25);
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
  paths.quarters.push_back(k % 2 ? 1 : 15);
}

// Adds gains of a link through 15 beams of the transmitter. The best beam is that of the column.
void add_beams(BeamRows& beams, const Link& link, uint32_t column, uint32_t frame) {
  constexpr uint32_t count = 15;
  for (uint32_t beam = 0; beam < count; ++beam) {
    beams.tx.push_back(link.tx);
    beams.rx.push_back(link.rx);
    beams.tx_beam.push_back(beam);
    beams.rx_beam.push_back(0);
    beams.gain_db.push_back(-70 - 3.0 * frame - 0.5 * column - 10.0 * (beam != column % count));
  }
}

// Adds counts of all the paths of a frame.
void add_counts(FrameResult& frame, MadeRun::Found found = MadeRun::Found::rays) {
  frame.counts.paths = frame.paths.size();
  if (found == MadeRun::Found::rays) {
    frame.missed = missed_counts(frame.paths, 0, frame.paths.size());
    return;
  }
  frame.paths.quarters.clear();
  if (found == MadeRun::Found::beams)
    frame.certificate = {.frames = 1,
                         .depth = 5,
                         .edges = 2,
                         .any_depth = true,
                         .ends = 3,
                         .left_out_sr = 0x1p-30,
                         .left_out_power = 1e-11,
                         .weak_sr = 0.377,
                         .floor_db = -120};
  else
    frame.missed = {.unknown = 1};
}

RunSummary made_summary() {
  RunSummary summary;
  summary.device = {"a platform", "a processor", "1", "OpenCL C 1.2", false};
  return summary;
}

}  // namespace

void write_made_run(const MadeRun& made, const std::filesystem::path& folder) {
  Config config;
  config.radio = {.frequency_hz = frequency_hz, .transmit_power_dbm = 23, .bandwidth_hz = 1e7, .noise_figure_db = 9};
  config.text = "[scene]\n" + made.scene +
                "\n[radio]\ntransmit_power_dbm = 23\nbandwidth_hz = 1e7\nnoise_figure_db = 9\n"
                "[[transmitter]]\nname = \"rsu\"\nposition_m = [8.0, 8.0, 6.0]\n";
  Scene scene;
  std::vector<Scene> models(1);
  models[0].file = "car";
  std::vector<Instance> instances;
  std::vector<EndState> ends{{.position_m = {8, 8, 6}}};
  config.transmitters = {{.name = made.prefix + "rsu", .position_m = {8, 8, 6}}};
  for (uint32_t v = 0; v < made.vehicles; ++v) {
    instances.push_back({.id = fmt::format("veh{}", v), .type = "passenger"});
    const glm::dvec3 from = vehicle_position(v, 0), to = vehicle_position(v, 1000);
    config.text += fmt::format(
        "[[track]]\nid = \"veh{}\"\nwaypoints = [[0.0, {:.3f}, {:.3f}, 0.0], [1000.0, {:.3f}, {:.3f}, 0.0]]\n", v,
        from.x, from.y, to.x, to.y);
    const RadioEnd end{.name = fmt::format("{}veh{}/roof", made.prefix, v)};
    config.transmitters.push_back(end);
    config.receivers.push_back(end);
  }
  config.text += "[[mount]]\nname = \"roof\"\noffset_m = [0.0, 0.0, 1.6]\n";

  std::vector<FrameResult> frames(made.frames);
  for (uint32_t f = 0; f < made.frames; ++f) {
    FrameResult& frame = frames[f];
    frame.frame = f;
    WorldState& world = frame.world;
    world.time_s = 0.1 * f;
    world.transmitters = {{.position_m = {8, 8, 6}}};
    for (uint32_t v = 0; v < made.vehicles; ++v) {
      const glm::dvec3 at = vehicle_position(v, world.time_s);
      world.instances.push_back({.position_m = at, .velocity_m_s = {5, 0, 0}});
      const EndState end{.position_m = at + glm::dvec3(0, 0, 1.6), .velocity_m_s = {5, 0, 0}, .instance = v};
      world.transmitters.push_back(end);
      world.receivers.push_back(end);
    }
    for (uint32_t tx = 0; tx <= made.vehicles; ++tx)
      for (uint32_t rx = 0; rx < made.vehicles; ++rx)
        if (tx != rx + 1) world.links.push_back({tx, rx});
    for (const Link& link : world.links)
      for (uint32_t k = 0; k < made.paths_a_link; ++k)
        add_path(frame.paths, f, link, world.transmitters[link.tx], world.receivers[link.rx], k);
    add_counts(frame, made.found);
  }
  write_outputs(folder, {config, scene, instances, models, made_summary()}, frames);
}

void write_made_coverage(const MadeMap& made, const std::filesystem::path& folder) {
  const uint32_t columns = made.columns, rows = made.rows;
  Config config;
  config.radio.frequency_hz = frequency_hz;
  config.text =
      "[scene]\ngenerate = \"--seed 1 --blocks 1x1\"\n[radio]\ntransmit_power_dbm = 30.0\nbandwidth_hz = 2e7\n"
      "[[transmitter]]\nname = \"east\"\nposition_m = [150.0, 8.0, 6.0]\n"
      "[[receiver]]\nname = \"car\"\nposition_m = [20.0, 8.0, 1.5]\n";
  config.transmitters = {{.name = "east", .position_m = {0.5 * columns, 8, 6}},
                         {.name = "west", .position_m = {-0.5 * columns, 8, 6}}};
  config.receivers = {{.name = "car", .position_m = {20, 8, 1.5}}};
  for (uint32_t iy = 0; iy < rows; ++iy)
    for (uint32_t ix = 0; ix < columns; ++ix) {
      RadioEnd& cell = config.receivers.emplace_back();
      cell.name = fmt::format("map/{},{}", ix, iy);
      cell.position_m = {ix - 0.5 * columns + 0.5, iy - 0.5 * rows + 0.5, 1.5};
      if (made.upright) cell.position_m = {-3 + 0.6 * ix, 4 + 0.8 * ix, 1.0 + iy};
    }
  config.output.max_paths_per_link = made.max_paths_per_link;
  std::vector<FrameResult> frames(made.frames);
  for (uint32_t f = 0; f < made.frames; ++f) {
    FrameResult& frame = frames[f];
    frame.frame = f;
    frame.world.time_s = 0.5 * f;
    for (auto [ends, states] : {std::pair{&config.transmitters, &frame.world.transmitters},
                                std::pair{&config.receivers, &frame.world.receivers}})
      for (const RadioEnd& end : *ends)
        states->push_back({.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]}});
    frame.world.transmitters[0].position_m.x -= 6.0 * f;
    for (uint32_t tx = 0; tx < 2; ++tx)
      for (uint32_t rx = 0; rx <= columns * rows; ++rx) {
        frame.world.links.push_back({tx, rx});
        const uint32_t ix = rx == 0 ? 0 : (rx - 1) % columns;
        for (uint32_t k = ix % 3; k < 2; ++k)
          add_path(frame.paths, f, {tx, rx}, frame.world.transmitters[tx], frame.world.receivers[rx], k);
        if (made.beams && rx > 0 && ix % 3 < 2) add_beams(frame.beams, {tx, rx}, ix, f);
      }
    add_counts(frame);
  }
  write_outputs(folder, {config, {}, {}, {}, made_summary()}, frames);
}

void write_made_rays(const std::filesystem::path& folder) {
  Config config;
  config.radio.frequency_hz = frequency_hz;
  config.text =
      "[scene]\ngenerate = \"--seed 1 --blocks 2x2\"\n[[transmitter]]\nname = \"rsu\"\nposition_m = [0.0, 0.0, 10.0]\n"
      "[[receiver]]\nname = \"car\"\nposition_m = [15.0, 5.0, 1.5]\n";
  config.transmitters = {{.name = "rsu", .position_m = {0, 0, 10}}};
  config.receivers = {{.name = "car", .position_m = {15, 5, 1.5}}};
  config.output.waypoints = 2;
  std::vector<FrameResult> frames(2);
  for (uint32_t f = 0; f < 2; ++f) {
    frames[f].frame = f;
    frames[f].world.transmitters = {{.position_m = {0, 0, 10}}};
    frames[f].world.receivers = {{.position_m = {15, 5, 1.5}}};
    using enum WaypointKind;
    using Source = WaypointSource;
    WaypointRows& rows = frames[f].waypoints;
    rows.frame.assign(8, f);
    rows.tx.assign(8, 0);
    rows.sample = {3, 3, 3, 3, 3, 9, 9, 9};
    rows.depth = {0, 1, 2, 2, 3, 0, 1, 2};
    rows.kind = {launch, reflection, hit, reflection, miss, launch, reflection, miss};
    rows.position_m = {{0, 0, 10},        {10.0 + f, 0, 0}, {15, 5, 1.5},     {10.0 + f, 10, 5},
                       {10.0 + f, 10, 6}, {0, 0, 10},       {20.0 + f, 0, 0}, {20.0 + f, 0, 1}};
    rows.surface.assign(8, no_surface);
    rows.instance.assign(8, no_instance);
    rows.source = {Source::launch, Source::traced, Source::cache, Source::cache,
                   Source::traced, Source::launch, Source::cache, Source::traced};
  }
  write_outputs(folder, {config, {}, {}, {}, made_summary()}, frames);
}

}  // namespace wavetracer::test
