// SPDX-License-Identifier: Apache-2.0
// Paths are straight lines with made-up points along them; places of vehicles and ends are those of the world.
#include "vtk_glb_kml_run.hpp"
#include <cmath>
#include <limits>
#include "scene/load.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::test {
namespace {

constexpr const char* text = R"(
scene.generate = "--seed 1 --blocks 2x2"
links.v2v = true
time = {start_s = 0.0, end_s = 0.5, step_s = 0.1}
[[material]]
name = "brick"
permittivity = 4.0
[[material]]
name = "hedge"
vegetation = "deciduous"
attenuation_db_m = 1.5
[[vegetation]]
centre_m = [5.0, 6.0, 6.0]
size_m = [4.0, 5.0, 6.0]
[[vegetation]]
shape = "box"
centre_m = [-6.0, 6.0, 1.0]
size_m = [8.0, 1.0, 2.0]
yaw_deg = 90.0
material = "hedge"
[[vegetation]]
shape = "cylinder"
centre_m = [-6.0, 20.0, 1.0]
size_m = [2.0, 2.0, 4.0]
material = "hedge"
[[transmitter]]
name = "<rsu> & \"co\" é"
position_m = [8.0, 7.5, 6.0]
[[receiver]]
name = "sign"
position_m = [-8.0, 7.5, 2.25]
[[track]]
id = "car<1>"
waypoints = [[0.0, -40.0, -3.0, 0.0], [0.5, -30.0, -3.0, 0.0]]
[[track]]
id = "lorry"
type = "truck"
waypoints = [[0.3, -3.0, 30.0, 0.0], [0.4, -3.0, 29.0, 0.0]]
[[mount]]
name = "roof"
on = "car*"
offset_m = [0.0, 0.0, 1.6]
)";

void add_path(Paths& paths, const WorldState& world, const glm::dvec3& origin_m, uint32_t frame, uint32_t i) {
  const uint32_t depth = i % 4;
  const glm::dvec3 from = world.transmitters[0].position_m + origin_m, to = world.receivers[1].position_m + origin_m;
  paths.frame.push_back(frame);
  paths.tx.push_back(0);
  paths.rx.push_back(1);
  paths.depth.push_back(depth);
  paths.delay_s.push_back(1e-7 + 1e-10 * i);
  paths.gain_db.push_back(i == 0 ? -std::numeric_limits<double>::infinity() : -80.25 - 0.05 * i);
  paths.a.push_back({std::pow(10.0, paths.gain_db.back() / 20)});
  for (auto* angle : {&paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    angle->push_back(0.5);
  paths.doppler_hz.push_back(3.0 * i - 7);
  for (uint32_t k = 0; k < depth; ++k) {
    const double part = (k + 1.0) / (depth + 1.0);
    paths.vertex_position_m.push_back(from + (to - from) * part + glm::dvec3(0, 0, 0.01 * i));
    paths.vertex_interaction.push_back(k == 1 ? diffraction : k == 2 ? transmission : reflection);
    paths.vertex_surface.push_back(k);
    paths.vertex_instance.push_back(k == 2 ? 0 : no_instance);
  }
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
}

// Two rays: one that a car reflects and that passes a receiver, one that is lost at once.
WaypointRows made_rays(uint32_t frame) {
  using enum WaypointKind;
  using Source = WaypointSource;
  return {.frame = std::vector<uint32_t>(6, frame),
          .tx = {0, 0, 0, 0, 1, 1},
          .sample = {7, 7, 7, 7, uint64_t{1} << 40, uint64_t{1} << 40},
          .depth = {0, 1, 2, 2, 0, 1},
          .kind = {launch, reflection, hit, reflection, launch, miss},
          .position_m = {{0, 0, 6}, {1.0 * frame, 2, 0}, {3, 3, 1}, {4, 4, 2.5}, {-8, 0, 2}, {-8, 0, 3}},
          .surface = {no_surface, 3, 0, 17, no_surface, no_surface},
          .instance = {no_instance, 0, no_instance, no_instance, no_instance, no_instance},
          .source = {Source::launch, Source::traced, Source::cache, Source::cache, Source::launch, Source::traced}};
}

}  // namespace

void write_geometry_run(const std::filesystem::path& folder) {
  Config config = parse_config(text, "/geometry.toml");
  const Scene scene = load_scene(config);
  const World world = make_world(config, scene);
  config.transmitters = world.transmitters.ends;
  config.receivers = world.receivers.ends;
  config.output.waypoints = 2;
  std::vector<FrameResult> frames;
  for (uint32_t number = first_frame; number < first_frame + frame_count; ++number) {
    FrameResult frame;
    frame.frame = number;
    frame.world = world.state(number);
    const uint32_t row = number - first_frame, rows = row + 1 == frame_count ? rows_of_last_frame : 1 + 10 * row;
    for (uint32_t i = 0; i < rows; ++i) add_path(frame.paths, frame.world, scene.origin_m, number, i);
    frame.counts.paths = rows;
    frame.segments_per_depth = {1};
    frame.seconds = {{"frame", 0.1}};
    frame.waypoints = made_rays(number);
    frames.push_back(std::move(frame));
  }
  write_outputs(folder, Run{config, scene, world.fleet.instances, world.fleet.models, {}}, frames);
}

}  // namespace wavetracer::test
