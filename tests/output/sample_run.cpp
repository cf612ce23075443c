// SPDX-License-Identifier: Apache-2.0
// Builds the sample run: path i has depth i, delay 1e-7 (i + 1) s and so on, see path_row().
// Transmitters have one port, receivers two.
#include "output/sample_run.hpp"
#include "radar/radar_cube.hpp"

namespace wavetracer {
namespace {

void add_path(Paths& paths, uint32_t frame, uint32_t tx, uint32_t rx, uint32_t i) {
  paths.frame.push_back(frame);
  paths.tx.push_back(tx);
  paths.rx.push_back(rx);
  paths.depth.push_back(i);
  paths.delay_s.push_back(1e-7 * (i + 1));
  paths.gain_db.push_back(-80.0 - i);
  paths.a.push_back({{{1e-4 * i, 1.0}, {2e-4 * i, -1.0}}});
  paths.aod_theta_rad.push_back(0.1 * i);
  paths.aod_phi_rad.push_back(0.2 * i);
  paths.aoa_theta_rad.push_back(0.3 * i);
  paths.aoa_phi_rad.push_back(-0.4 * i);
  paths.doppler_hz.push_back(10.0 * i);
  for (uint32_t k = 0; k < i; ++k) {
    paths.vertex_position_m.push_back({1e6 + i, k / 3.0, 0.25});
    paths.vertex_interaction.push_back(k % 2 ? transmission : reflection);
    paths.vertex_surface.push_back(100 * i + k);
    paths.vertex_instance.push_back(k == 0 ? no_instance : k % 2);
  }
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
}

std::vector<EndState> states(const std::vector<RadioEnd>& ends, const glm::dvec3& origin_m) {
  std::vector<EndState> out;
  for (const RadioEnd& end : ends) {
    EndState state;
    state.position_m = glm::dvec3(end.position_m[0], end.position_m[1], end.position_m[2]) - origin_m;
    state.velocity_m_s = {end.velocity_m_s[0], end.velocity_m_s[1], end.velocity_m_s[2]};
    out.push_back(state);
  }
  return out;
}

FrameResult make_frame(const SampleRun& sample, uint32_t number, double time_s) {
  FrameResult frame;
  frame.frame = number;
  frame.world.time_s = time_s;
  frame.world.transmitters = states(sample.config.transmitters, sample.scene.origin_m);
  frame.world.receivers = states(sample.config.receivers, sample.scene.origin_m);
  frame.world.instances.resize(sample.instances.size());
  frame.world.links = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  return frame;
}

// Numbers of the row alone.
void add_entry(FrameResult& frame, uint32_t row) {
  CacheEntryRows& rows = frame.cache_entries;
  rows.frame.push_back(frame.frame);
  rows.slot.push_back(10 * row);
  rows.region.push_back(row);
  rows.depth.push_back(row + 1);
  rows.hits.push_back(5 * row);
  rows.age.push_back(frame.frame);
  rows.length_m.push_back(0.5 * row);
  rows.read_cycles.push_back(100 * row);
  rows.write_cycles.push_back(200);
}

void add_counts(FrameResult& frame) {
  frame.paths.rx_ports = 2;
  frame.counts = {1000, 2500, 1500, 40, 12, 8, frame.paths.size(), 3};
  frame.segments_per_depth = {1000, 900, 600};
  frame.warnings = {"a warning"};
}

}  // namespace

WaypointRows sample_waypoints(uint32_t frame, size_t count) {
  WaypointRows rows{
      .frame = {frame, frame, frame, frame},
      .tx = {0, 0, 0, 1},
      .sample = {5, 5, 5, uint64_t{1} << 40},
      .depth = {0, 1, 2, 2},
      .kind = {WaypointKind::launch, WaypointKind::reflection, WaypointKind::hit, WaypointKind::miss},
      .position_m = {{1e6 + frame, 0, 0}, {1e6 + frame, 0.25, -1}, {1e6 + frame, 0.5, -2}, {1e6 + frame, 0.75, -3}},
      .surface = {no_surface, 17, 1, no_surface},
      .instance = {no_instance, 1, no_instance, no_instance},
      .source = {WaypointSource::launch, WaypointSource::cache, WaypointSource::unknown, WaypointSource::traced}};
  const auto shorten = [count](auto&... columns) { (columns.resize(count), ...); };
  shorten(rows.frame, rows.tx, rows.sample, rows.depth, rows.kind, rows.position_m, rows.surface, rows.instance,
          rows.source);
  return rows;
}

SampleRun::SampleRun() {
  config.file = "/configs/sample.toml";
  config.text = "scene.file = \"scene.xml\"  # \xC3\xA9\n";
  config.transmitters = {
      {.name = "rsu, north", .position_m = {1, 2, 3}},
      {.name = "rsu", .position_m = {4, 5, 6}, .orientation_deg = {90, 10, 0}, .velocity_m_s = {0, -3, 0.5}}};
  config.receivers = {{.name = "car", .position_m = {7, 8, 9}, .antenna = "dipole", .polarization = "VH"},
                      {.name = ""}};
  scene.file = "/scenes/scene.xml";
  scene.origin_m = {512, -256, 0};
  scene.report.warnings = {"a scene warning"};
  models.resize(2);
  models[0].file = "car";
  models[1].file = "/models/bus.glb";
  models[1].origin_m = {0.5, 0, 1};
  instances = {{.id = "v0", .type = "passenger"}, {.id = "v1", .type = "bus", .model = 1}};
}

Run SampleRun::run() const {
  Run run{config, scene, instances, models, {}};
  run.summary.device = {"Portable Computing Language", "a processor", "3.1", "OpenCL C 1.2", false};
  run.summary.features = {{"reflection", {true, {}}}, {"diffraction", {false, "no edge of the scene diffracts"}}};
  run.summary.setup_seconds = {{"load", 0.5}, {"trace", 9.0}};
  run.summary.command_line = "wavetracer run -c sample.toml";
  run.summary.inputs = {{"scene.file", "/data/scene.xml", 100, 42}, {"scene.file: a.ply", "/data/a.ply", 7, 43}};
  run.summary.repeat_count = 3;
  run.summary.warnings = {"a run warning", "a warning"};
  for (const RadarConfig& radar : config.radars)
    run.radars.push_back(radar_axes(radar, 1, 2, config.radio.frequency_hz));
  return run;
}

std::vector<FrameResult> SampleRun::frames() const {
  FrameResult first = make_frame(*this, 7, 0.0), second = make_frame(*this, 8, 0.1);
  first.seconds = {{"trace", 0.25}, {"solve", 0.125}, {"frame", 0.5}};
  second.seconds = {{"trace", 0.75}, {"solve", 0.375}, {"frame", 1.5}};
  add_path(first.paths, 7, 0, 0, 0);
  add_path(first.paths, 7, 0, 1, 1);
  add_path(first.paths, 7, 1, 0, 2);
  add_path(second.paths, 8, 0, 0, 3);
  add_path(second.paths, 8, 1, 1, 4);
  first.world.instances[0].position_m = {1, 2, 3};
  first.world.instances[1].present = false;
  second.world.instances[0].position_m = {4, 2, 3};
  second.world.instances[1] = {.position_m = {10, 20, 2},
                               .rotation = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1),  // a quarter turn to the left
                               .velocity_m_s = {0, 8, 0},
                               .angular_velocity_rad_s = {0, 0, 2}};
  add_counts(first);
  add_counts(second);
  return {first, second};
}

std::vector<FrameResult> SampleRun::empty() const { return {make_frame(*this, 0, 0)}; }

std::vector<FrameResult> SampleRun::drive(uint32_t first, uint32_t count) const {
  std::vector<FrameResult> frames;
  for (uint32_t number = first; number < first + count; ++number) {
    FrameResult frame = make_frame(*this, number, 0.1 * number);
    frame.seconds = {{"trace", 0.25}, {"frame", 0.5 + 0.001 * number}};
    frame.world.links = {{0, 0}, {1, 0}};
    if (number % 5 == 4) frame.world.links.clear();
    for (const Link& link : frame.world.links)
      for (uint32_t i = 0; i < (number * 7 + link.tx * 3) % 4; ++i) add_path(frame.paths, number, link.tx, link.rx, i);
    frame.world.receivers[1].present = false;
    frame.world.transmitters[0].position_m.x += number;
    frame.world.instances[0].present = number % 3 > 0;
    frame.world.instances[1].position_m.y = 2.0 * number;
    for (uint32_t row = 0; config.output.cache_entries && row < number % 3; ++row) add_entry(frame, row);
    if (config.output.waypoints > 0) frame.waypoints = sample_waypoints(number, number % 4);
    add_counts(frame);
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace wavetracer
