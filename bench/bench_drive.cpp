// SPDX-License-Identifier: Apache-2.0
// bench_drive measures frames of moving worlds: a hundred vehicles in munich that all talk to each other, and then are
// targets of sensing as well, a thousand in a generated city, links between fixed antennas among moving cars compared
// with Sionna RT, placing instances, and memory over a thousand frames. The machine must be quiet. "error" is 1 - the
// power recall against cold frames of many more rays; for memory it is the growth in MiB.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "continuous.hpp"
#include "drive.hpp"
#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "motion/vehicle_types.hpp"
#include "resident.hpp"
#include "scene/load.hpp"
#include "sensing.hpp"
#include "street.hpp"
#include "street_traffic.hpp"
#include "top_level_times.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

constexpr double millisecond_s = 0.001, antenna_height_m = 1.5, above_roof_m = 0.15, radius_m = 300;
const glm::dvec3 crossing_m(45, 90, antenna_height_m);  // a crossing of streets in munich, in the open

// Sionna RT 2.2.0 in munich, 5.9 GHz, depth 5, line of sight and specular reflection; measured on 2026-11-21, the GPU
// an H200 with 100 cars, the CPU two cores with 20. For 10 x 100 links it is the still frame plus the time that moving
// cars added in the other case.
constexpr uint64_t sionna_rays = 1'000'000;
constexpr double sionna_1x10_gpu_s = 0.40, sionna_1x10_cpu_s = 2.0, sionna_10x100_gpu_s = 1.35 + 0.25;
constexpr size_t sionna_gpu_cars = 100, sionna_cpu_cars = 20;

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> cases{"drive", "city", "continuous", "sensing", "links", "top-level", "memory"};
  uint32_t frames = 30, memory_frames = 1000;
  double step_s = 0.04;
  size_t vehicles = 100, runs = 21;
  std::vector<uint64_t> rays, refresh;
  std::vector<uint32_t> depth{3, 5};
  uint64_t reference_rays = 0, link_rays = sionna_rays;
  size_t city_vehicles = 1000;
  uint32_t blocks = 12;
  double max_distance_m = 300;
  bool no_reference = false, gpu = false;
};

// Returns an antenna for every vehicle, above the roof of its type.
std::vector<MountConfig> roof_mounts(const std::set<std::string>& types) {
  std::vector<MountConfig> mounts;
  for (const std::string& type : types)
    mounts.push_back({.name = "roof", .on = type, .offset_m = {0, 0, sumo_type(type)->height_m + above_roof_m}});
  return mounts;
}

Config munich(const Options& options) {
  Config config;
  config.scene.file = (fs::path(options.shared) / "scenes" / "munich" / "munich.xml").string();
  config.time = {.start_s = 0, .end_s = (options.frames - 1) * options.step_s, .step_s = options.step_s};
  return config;
}

StreetTraffic traffic_of(const Options& options, size_t vehicles) {
  return {.vehicles = vehicles,
          .duration_s = std::max(options.frames - 1, 1u) * options.step_s,
          .centre_m = crossing_m,
          .radius_m = radius_m};
}

// All vehicles talk to each other.
Config talking_vehicles(const Options& options) {
  Config config = munich(options);
  config.tracks = street_traffic(load_scene(config), traffic_of(options, options.vehicles));
  std::set<std::string> types;
  for (const TrackConfig& track : config.tracks) types.insert(track.type);
  config.mounts = roof_mounts(types);
  config.links.max_distance_m = options.max_distance_m;
  return config;
}

// A thousand vehicles in the streets of a generated city, ten frames a second.
void run_city(const Options& options, const std::string& command) {
  constexpr double step_s = 0.1;
  const std::string city = fmt::format("--seed 1 --blocks {0}x{0}", options.blocks);
  Drive drive;
  drive.frames = options.frames;
  drive.name = fmt::format("city of {0} x {0} blocks, {1} vehicles, links of at most {2:g} m", options.blocks,
                           options.city_vehicles, options.max_distance_m);
  drive.config.scene.generate = city;
  drive.config.trajectories.generate =
      fmt::format("{} --vehicles {} --seconds {:.1f} --step {:.1f}", city, options.city_vehicles,
                  std::max(options.frames - 1, 1u) * step_s, step_s);
  drive.config.mounts = roof_mounts({"passenger", "delivery", "truck"});
  drive.config.links.max_distance_m = options.max_distance_m;
  drive.config.trace.max_depth = options.depth.front();
  const References references = solve_references(drive, options.reference_rays, options.device);
  for (const uint64_t refresh : options.refresh)
    measure(drive, {.reuse = true, .rays = options.rays.back(), .refresh_rays = refresh}, references, options.device,
            command);
}

// Makes two discoveries after the first.
void run_continuous(const Options& given, const std::string& command) {
  Options options = given;
  options.step_s = millisecond_s;
  options.frames = 201;
  Config config = talking_vehicles(options);
  config.trace.max_depth = options.depth.front();
  config.trace.rays = *std::max_element(options.rays.begin(), options.rays.end());
  for (const double every_s : {0.1, 0.03})
    measure_continuous(fmt::format("munich, {} vehicles, depth {}: steps of 1 ms{}", options.vehicles,
                                   options.depth.front(), every_s == 0.1 ? "" : ", rays every 30 ms"),
                       config, every_s, options.device, command);
}

void run_sensing(const Options& options, const std::string& command) {
  Config config = talking_vehicles(options);
  config.trace.max_depth = options.depth.front();
  config.trace.rays = *std::max_element(options.rays.begin(), options.rays.end());
  print_sensing(fmt::format("munich, {} vehicles", options.vehicles), config, options.frames, options.device, command);
}

void run_drive(const Options& options, const std::string& command) {
  Drive drive{.config = talking_vehicles(options), .frames = options.frames};
  const uint64_t most_rays = *std::max_element(options.rays.begin(), options.rays.end());
  for (const uint32_t depth : options.depth) {
    drive.name = fmt::format("munich, {} vehicles, depth {}", options.vehicles, depth);
    drive.config.trace.max_depth = depth;
    const References references = solve_references(drive, options.reference_rays, options.device);
    const auto run = [&](const Setting& setting) {
      return measure(drive, setting, references, options.device, command);
    };
    double cold_s = 0;
    for (const uint64_t rays : options.rays) {
      const double seconds = run({.rays = rays});
      if (rays == most_rays) cold_s = seconds;
    }
    for (const uint64_t refresh : options.refresh)
      run({true, most_rays, refresh, fmt::format("cold, {:.0e} rays", static_cast<double>(most_rays)), cold_s});
    const double cold_auto_s = run({});
    run({true, {}, {}, "cold, auto rays", cold_auto_s});
  }
}

std::vector<RadioEnd> ends(const char* prefix, const std::vector<glm::dvec3>& points) {
  std::vector<RadioEnd> result;
  for (const glm::dvec3& p : points)
    result.push_back({.name = fmt::format("{}{}", prefix, result.size()), .position_m = {p.x, p.y, p.z}});
  return result;
}

// Returns links between fixed antennas in the streets, with cars that drive between them.
Drive links_among_cars(const Options& options, size_t transmitters, size_t receivers, size_t cars) {
  Drive drive{.config = munich(options), .frames = options.frames};
  const Scene scene = load_scene(drive.config);
  std::vector<glm::dvec3> points =
      street_points(scene, crossing_m, radius_m, antenna_height_m, transmitters + receivers - 1);
  points.insert(points.begin(), crossing_m);
  const auto border = points.begin() + static_cast<std::ptrdiff_t>(transmitters);
  drive.config.transmitters = ends("tx", {points.begin(), border});
  drive.config.receivers = ends("rx", {border, points.end()});
  StreetTraffic traffic = traffic_of(options, cars);
  traffic.standing_m = points;
  drive.config.tracks = street_traffic(scene, traffic);
  drive.name = fmt::format("munich, {} moving cars, {} x {} links", cars, transmitters, receivers);
  return drive;
}

void run_links(const Options& options, const std::string& command) {
  const size_t cars = options.gpu ? sionna_gpu_cars : sionna_cpu_cars;
  const auto run = [&](size_t transmitters, size_t receivers, const std::string& baseline,
                       const std::optional<double>& baseline_s) {
    const Drive drive = links_among_cars(options, transmitters, receivers, cars);
    const References references = solve_references(drive, options.reference_rays, options.device);
    const bool comparable = options.link_rays == sionna_rays && baseline_s;
    for (const bool reuse : {false, true}) {
      Setting setting{.reuse = reuse, .rays = options.link_rays};
      if (comparable) {
        setting.baseline = baseline;
        setting.baseline_s = baseline_s;
      }
      measure(drive, setting, references, options.device, command);
    }
  };
  run(1, 10, options.gpu ? "Sionna RT 2.2 on an H200" : "Sionna RT 2.2 on a 2-core CPU",
      options.gpu ? sionna_1x10_gpu_s : sionna_1x10_cpu_s);
  run(10, 100, "Sionna RT 2.2 on an H200: its still frame of 1.35 s, and 0.25 s to move 100 cars",
      options.gpu ? std::optional(sionna_10x100_gpu_s) : std::nullopt);
}

void run_memory(const Options& options, const std::string& command) {
  constexpr uint32_t settled = 10;
  constexpr double memory_step_s = 0.1;
  Config config;
  config.scene.generate = "--seed 1";
  config.trajectories.generate = fmt::format("--seed 1 --vehicles 20 --seconds {:.1f} --step {:.1f}",
                                             (options.memory_frames - 1) * memory_step_s, memory_step_s);
  config.mounts = roof_mounts({"passenger", "delivery", "truck"});
  config.links.max_distance_m = 150;
  config.trace.rays = 10'000;
  config.trace.max_depth = 3;
  Simulation simulation(config, options.device);
  const auto frames = static_cast<uint32_t>(std::min<uint64_t>(simulation.frame_count(), options.memory_frames));
  nlohmann::ordered_json resident;
  double settled_bytes = 0, bytes = 0;
  size_t most_paths = 0;
  for (uint32_t frame = 0; frame < frames; frame++) {
    most_paths = std::max(most_paths, simulation.run_frame(frame).paths.size());
    const uint32_t done = frame + 1;
    if (done != settled && done != 100 && done != frames) continue;
    bytes = resident_bytes();
    if (done == settled) settled_bytes = bytes;
    resident[std::to_string(done)] = bytes;
    fmt::print(stderr, "memory: {:.1f} MiB after {} frames\n", bytes / 0x1p20, done);
  }
  Result line;
  line.bench = "drive";
  line.name = fmt::format("memory: {} frames of a drive of 20 vehicles", frames);
  line.device = simulation.device().name;
  line.value = bytes;
  line.unit = "B";
  line.better = Better::lower;
  line.baseline = fmt::format("after {} frames", settled);
  line.baseline_value = settled_bytes;
  line.error = (bytes - settled_bytes) / 0x1p20;
  line.detail = fmt::format("{:.1f} MiB after {} frames, {:.1f} MiB after all; at most {} paths per frame",
                            settled_bytes / 0x1p20, settled, bytes / 0x1p20, most_paths);
  line.extra = {{"resident_bytes", resident}};
  print(line, command);
}

// If a case fails, the others still run. Returns the exit status.
int run(Options options, const std::string& command) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  options.gpu = devices[gpu::choose_device(devices, options.device)].gpu;
  const auto set_default = [&](std::vector<uint64_t>& numbers, std::vector<uint64_t> gpu, std::vector<uint64_t> cpu) {
    if (numbers.empty()) numbers = options.gpu ? std::move(gpu) : std::move(cpu);
  };
  set_default(options.rays, {100'000, 1'000'000}, {10'000, 100'000});
  set_default(options.refresh, {100'000, 30'000, 10'000}, {10'000, 3'000, 1'000});
  if (options.reference_rays == 0) options.reference_rays = options.gpu ? 10'000'000 : 1'000'000;
  if (options.no_reference) options.reference_rays = 0;

  int status = 0;
  for (const std::string& name : options.cases) {
    try {
      if (name == "drive") run_drive(options, command);
      if (name == "city") run_city(options, command);
      if (name == "continuous") run_continuous(options, command);
      if (name == "sensing") run_sensing(options, command);
      if (name == "links") run_links(options, command);
      if (name == "top-level") print_top_level_times(options.device, options.runs, command);
      if (name == "memory") run_memory(options, command);
    } catch (const Error& error) {
      fmt::print(stderr, "bench_drive: case {}: {}\n", name, error.what());
      status = static_cast<int>(error.code());
    }
  }
  return status;
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Frames of moving worlds: seconds, recall, and memory");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich/munich.xml");
  app.add_option("--cases", options.cases, "some of drive, city, continuous, sensing, links, top-level, memory")
      ->check(CLI::IsMember({"drive", "city", "continuous", "sensing", "links", "top-level", "memory"}));
  app.add_option("--frames", options.frames, "frames of a drive, 0.04 s apart")->check(CLI::Range(2, 1000));
  app.add_option("--vehicles", options.vehicles, "vehicles of the case drive")->check(CLI::Range(2, 10000));
  app.add_option("--city-vehicles", options.city_vehicles, "vehicles of the case city")->check(CLI::Range(2, 10000));
  app.add_option("--blocks", options.blocks, "blocks of the city along each side")->check(CLI::Range(2, 100));
  app.add_option("--rays", options.rays, "rays per transmitter of cold frames; the most of them for reuse, too");
  app.add_option("--refresh", options.refresh, "rays per transmitter that frames launch anew where they reuse");
  app.add_option("--depth", options.depth, "depths of the case drive");
  app.add_option("--max-distance", options.max_distance_m, "metres of a link of the case drive");
  app.add_option("--reference-rays", options.reference_rays, "rays per transmitter of frames that errors refer to");
  app.add_flag("--no-reference", options.no_reference, "do not measure errors");
  app.add_option("--link-rays", options.link_rays, "rays per transmitter of the case links");
  app.add_option("--runs", options.runs, "timed runs of the case top-level")->check(CLI::Range(3, 1000));
  app.add_option("--memory-frames", options.memory_frames, "frames of the case memory")->check(CLI::Range(11, 100000));
  CLI11_PARSE(app, argc, argv);
  try {
    return bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_drive: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
