// bench_paths: seconds a frame from poses to fields, for one to a thousand links in munich, beside Sionna RT.
// Assumes a quiet machine. "error" is the share of paths that are missed, among those that many more rays find.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>

#include "frames.hpp"
#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "reference/compare.hpp"
#include "scene/city.hpp"
#include "scene/load.hpp"
#include "street.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

constexpr double frequency_hz = 5.9e9;
constexpr uint32_t max_depth = 5;
constexpr double antenna_height_m = 1.5, radius_m = 300;  // as cars have them; "around the corner", not "out of town"
constexpr size_t most_transmitters = 10, most_receivers = 100;

struct Case {
  size_t transmitters, receivers;
  uint64_t rays;
  // Seconds a warm solve of Sionna RT 2.2.0 (Mitsuba 3.9, Dr.Jit) in munich, 5.9 GHz, isotropic V, depth 5, line of
  // sight and specular reflection; measured on 2026-11-21. The CPU: two cores, LLVM 19; the GPU: one NVIDIA H200,
  // OptiX. Antennas stood at other places of the same streets: --peer compares on the same ones.
  std::optional<double> sionna_cpu_s, sionna_gpu_s;
};

const Case cases[] = {
    {1, 1, 100'000, 0.061, 0.0149},   {1, 1, 1'000'000, 0.285, 0.0178}, {1, 1, 10'000'000, 2.63, 0.0505},
    {1, 10, 1'000'000, 1.49, 0.0423}, {1, 100, 1'000'000, 9.8, 0.170},  {1, 100, 10'000'000, {}, 1.46},
    {10, 100, 1'000'000, {}, 1.35},   {10, 100, 10'000'000, {}, 13.2},
};
constexpr uint64_t large_rays = 10'000'000;  // cases of so many are for GPUs, and for --large

struct Options {
  std::string device, shared = WAVETRACER_SHARED, peer, write_links;
  size_t frames = 7;
  uint64_t reference_rays = 30'000'000;
  bool large = false;
};

struct Place {
  std::string name;
  SceneConfig scene;
  std::vector<RadioEnd> transmitters, receivers;
};

std::vector<RadioEnd> ends(const char* prefix, const std::vector<glm::dvec3>& points) {
  std::vector<RadioEnd> result;
  for (const glm::dvec3& p : points)
    result.push_back({.name = fmt::format("{}{}", prefix, result.size()), .position_m = {p.x, p.y, p.z}});
  return result;
}

Place load_place(const std::string& shared) {
  Place place;
  Config config;
  glm::dvec3 first(45, 90, antenna_height_m);  // a street crossing, in the open
  const fs::path munich = fs::path(shared) / "scenes" / "munich" / "munich.xml";
  if (fs::exists(munich)) {
    place.name = "munich";
    config.scene.file = munich.string();
  } else {
    fmt::print(stderr, "bench_paths: {} is not there, so the generated city is used and there is no baseline\n",
               munich.string());
    place.name = "city";
    config.scene.generate = "--seed 1";
    const auto& position = example_positions(parse_city_options(config.scene.generate)).front().position_m;
    first = {position[0], position[1], position[2]};
  }
  place.scene = config.scene;
  // The receivers, then the transmitters after the first one.
  auto points =
      street_points(load_scene(config), first, radius_m, antenna_height_m, most_receivers + most_transmitters - 1);
  const auto border = points.begin() + static_cast<std::ptrdiff_t>(most_receivers);
  // The nearest receiver leads, so that the single link is one that has paths.
  std::iter_swap(points.begin(), std::min_element(points.begin(), border, [&](const auto& a, const auto& b) {
                   return glm::distance(a, first) < glm::distance(b, first);
                 }));
  std::vector<glm::dvec3> transmitters{first};
  transmitters.insert(transmitters.end(), border, points.end());
  place.transmitters = ends("tx", transmitters);
  place.receivers = ends("rx", {points.begin(), border});
  return place;
}

// What bench/peers/sionna_rt.py reads, so that both solve the same links.
void write_links(const Place& place, const std::string& file) {
  nlohmann::ordered_json json{{"scene", place.name}, {"frequency_hz", frequency_hz}, {"max_depth", max_depth}};
  for (const RadioEnd& end : place.transmitters) json["transmitters_m"].push_back(end.position_m);
  for (const RadioEnd& end : place.receivers) json["receivers_m"].push_back(end.position_m);
  std::ofstream out(file);
  out << json.dump(1) << "\n";
  if (!out.flush()) throw RuntimeError(fmt::format("cannot write {}: is its folder there, and writable?", file));
}

std::string links_name(size_t transmitters, size_t receivers) { return fmt::format("{}x{}", transmitters, receivers); }

using Peer = std::map<std::pair<std::string, uint64_t>, nlohmann::json>;  // by links and rays

Peer read_peer(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("cannot read {}, which --peer names", file));
  Peer peer;
  std::string line;
  for (size_t number = 1; std::getline(in, line); number++) {
    try {
      const auto json = nlohmann::json::parse(line);
      peer[{json.at("links").get<std::string>(), json.at("rays").get<uint64_t>()}] = {
          {"name", json.at("device")}, {"seconds", json.at("value").get<double>()}, {"paths", json.at("paths")}};
    } catch (const nlohmann::json::exception& error) {
      throw InputError(
          fmt::format("{}:{}: {}; expected a line of bench/peers/sionna_rt.py", file, number, error.what()));
    }
  }
  return peer;
}

Simulation make_simulation(const Place& place, size_t transmitters, size_t receivers, uint64_t rays,
                           const std::string& device) {
  Config config;
  config.scene = place.scene;
  config.radio.frequency_hz = frequency_hz;
  config.trace.rays = rays;
  config.trace.max_depth = max_depth;
  config.transmitters.assign(place.transmitters.begin(),
                             place.transmitters.begin() + static_cast<std::ptrdiff_t>(transmitters));
  config.receivers.assign(place.receivers.begin(), place.receivers.begin() + static_cast<std::ptrdiff_t>(receivers));
  return Simulation(config, device);
}

void set_baseline(Result& result, const Case& c, const Place& place, const Peer& peer, bool gpu) {
  if (!peer.empty()) {
    const auto found = peer.find({links_name(c.transmitters, c.receivers), c.rays});
    if (found == peer.end()) return;
    result.baseline = found->second.at("name");
    result.baseline_value = found->second.at("seconds");
    result.extra["baseline_paths"] = found->second.at("paths");
  } else if (const auto seconds = gpu ? c.sionna_gpu_s : c.sionna_cpu_s; seconds && place.name == "munich") {
    result.baseline = gpu ? "Sionna RT 2.2.0 on an H200, 2026-11-21" : "Sionna RT 2.2.0 on a 2-core CPU, 2026-11-21";
    result.baseline_value = seconds;
  }
}

void run(const Options& options, const std::string& command) {
  const Place place = load_place(options.shared);
  if (!options.write_links.empty()) {
    write_links(place, options.write_links);
    fmt::print(stderr, "bench_paths: wrote the places of {} transmitters and {} receivers to {}\n",
               place.transmitters.size(), place.receivers.size(), options.write_links);
    return;
  }
  const Peer peer = options.peer.empty() ? Peer{} : read_peer(options.peer);
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const bool gpu = devices[gpu::choose_device(devices, options.device)].gpu;
  std::map<std::string, reference::Case> references;  // by links
  for (const Case& c : cases) {
    if (c.rays >= large_rays && !gpu && !options.large) continue;
    Simulation simulation = make_simulation(place, c.transmitters, c.receivers, c.rays, options.device);
    const Frames frames = run_frames(simulation, options.frames);
    const std::string links = links_name(c.transmitters, c.receivers);
    reference::Case& reference = references[links];
    if (reference.name.empty()) {
      reference.name = links;
      reference.paths = make_simulation(place, c.transmitters, c.receivers, options.reference_rays, options.device)
                            .run_frame(0)
                            .paths;
    }
    const reference::Comparison comparison = reference::compare_paths(reference, frames.result.paths);

    Result result{"paths",
                  fmt::format("{}, {} links, {:.0e} rays a transmitter, error against {:.0e}", place.name, links,
                              static_cast<double>(c.rays), static_cast<double>(options.reference_rays)),
                  simulation.device().name,
                  frames.median_s,
                  "s a frame",
                  Better::lower,
                  "",
                  {},
                  comparison.reference > 0 ? 1 - comparison.recall : 0,
                  fmt::format("{} paths of {}; {:.6f} of the power; first frame {:.3f} s", comparison.mine,
                              comparison.reference, comparison.power_recall, frames.first_s)};
    result.extra = {{"links", links},
                    {"rays", c.rays},
                    {"paths", comparison.mine},
                    {"reference_paths", comparison.reference},
                    {"power_recall", comparison.power_recall},
                    {"first_frame_s", frames.first_s}};
    set_baseline(result, c, place, peer, gpu);
    print(result, command);
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Seconds a frame for one to a thousand links in munich, beside Sionna RT");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich/munich.xml");
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(5, 1000));
  app.add_option("--reference-rays", options.reference_rays, "rays a transmitter of the launch that errors refer to");
  app.add_flag("--large", options.large, "on a CPU, too, the cases of 1e7 rays");
  app.add_option("--peer", options.peer, "lines printed by bench/peers/sionna_rt.py: the baseline of this machine");
  app.add_option("--write-links", options.write_links, "write the places of all antennas to this file, and end");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_paths: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
