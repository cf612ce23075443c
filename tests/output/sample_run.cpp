// Builds the sample run: path i has depth i, delay 1e-7 (i + 1) s and so on, see path_row().
// Transmitters have one port, receivers two.
#include "output/sample_run.hpp"

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
    paths.vertex_instance.push_back(k == 0 ? no_instance : k);
  }
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
}

FrameResult make_frame(uint32_t paths) {
  FrameResult frame;
  frame.paths.rx_ports = 2;
  frame.counts = {1000, 2500, 1500, 40, 12, 8, paths};
  frame.segments_per_depth = {1000, 900, 600};
  frame.warnings = {"a warning"};
  return frame;
}

}  // namespace

SampleRun::SampleRun() {
  config.file = "/configs/sample.toml";
  config.text = "scene.file = \"scene.xml\"  # \xC3\xA9\n";
  config.transmitters = {{.name = "rsu, north", .position_m = {1, 2, 3}},
                         {.name = "rsu", .position_m = {4, 5, 6}, .orientation_deg = {90, 10, 0}, .velocity_m_s = {0, -3, 0.5}}};
  config.receivers = {{.name = "car", .position_m = {7, 8, 9}, .antenna = "dipole", .polarization = "VH"},
                      {.name = ""}};
  scene.file = "/scenes/scene.xml";
  scene.report.warnings = {"a scene warning"};
}

RunData SampleRun::data() const {
  RunData run{config, scene, {}, {}, 7, {0.0, 0.1}};
  run.summary.device = {"Portable Computing Language", "a processor", "3.1", "OpenCL C 1.2", false};
  run.summary.setup_seconds = {{"load", 0.5}, {"trace", 9.0}};
  run.summary.command_line = "wavetracer run -c sample.toml";
  run.summary.repeat_count = 3;
  run.summary.warnings = {"a run warning", "a warning"};
  FrameResult first = make_frame(3), second = make_frame(2);
  first.seconds = {{"trace", 0.25}, {"solve", 0.125}, {"frame", 0.5}};
  second.seconds = {{"trace", 0.75}, {"solve", 0.375}, {"frame", 1.5}};
  add_path(first.paths, 7, 0, 0, 0);
  add_path(first.paths, 7, 0, 1, 1);
  add_path(first.paths, 7, 1, 0, 2);
  add_path(second.paths, 8, 0, 0, 3);
  add_path(second.paths, 8, 1, 1, 4);
  run.frames = {first, second};
  return run;
}

RunData SampleRun::empty() const {
  RunData run{config, scene, {}, {}, 0, {}};
  run.frames.resize(1);
  return run;
}

}  // namespace wavetracer
