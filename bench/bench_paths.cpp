// SPDX-License-Identifier: Apache-2.0
// bench_paths measures seconds per frame from poses to fields, for one to a thousand links in munich, and compares with
// Sionna RT. The machine must be quiet. "error" is the share of paths that are missed, among those that many more rays
// find.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "frames.hpp"
#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "places.hpp"
#include "reference/compare.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t max_depth = 5;
constexpr size_t most_transmitters = 10, most_receivers = 100;

// Our rays per transmitter, and those of the peer: rays sent towards the horizon find more than ten times as many paths
// as the peer's, so the fair pair is the one in which ours miss no more paths.
struct Case {
  size_t transmitters, receivers;
  uint64_t rays, peer_rays;
  uint64_t diffraction_rays = 0;  // rays of a receiver, in cases with diffraction at wedges, without free edges

  bool diffraction() const { return diffraction_rays > 0; }
  std::string links() const { return fmt::format("{}x{}", transmitters, receivers); }
  std::string interactions() const { return diffraction() ? "reflection, diffraction" : "reflection"; }
};

constexpr uint64_t million = 1'000'000;
const Case cases[] = {
    {1, 1, 10'000, million},
    {1, 1, 30'000, million},
    {1, 1, 100'000, million},
    {1, 1, million, million},
    {1, 10, 100'000, million},
    {1, 100, 30'000, million},
    {1, 100, 50'000, million},
    {1, 100, 100'000, million},
    {1, 100, million, million},
    {10, 100, 10'000, 10 * million},
    {10, 100, 30'000, 10 * million},
    {10, 100, 100'000, 10 * million},
    {10, 100, million, 10 * million},
    {1, 1, 100'000, million, 10'000},
    {1, 1, 100'000, million, 100'000},
    {1, 1, million, million, 100'000},
    {1, 100, 100'000, million, 3'000},
    {1, 100, 100'000, million, 10'000},
    {1, 100, 100'000, million, 100'000},
    {1, 100, million, million, 100'000},
};

// Seconds per warm solve of Sionna RT 2.2.0 (Mitsuba 3.9, Dr.Jit) in munich, 5.9 GHz, isotropic V, depth 5, line of
// sight and specular reflection; measured on 2026-11-21. The CPU: two cores, LLVM 19; the GPU: one NVIDIA H200, OptiX.
// Antennas stood at other places of the same streets: --peer compares on the same ones. Those with diffraction stood at
// these places, on 2026-11-22.
struct MeasuredPeer {
  std::string_view links, interactions;
  uint64_t rays;
  std::optional<double> cpu_s, gpu_s;
};
const MeasuredPeer measured_peers[] = {
    {"1x1", "reflection", million, 0.285, 0.0178},
    {"1x10", "reflection", million, 1.49, 0.0423},
    {"1x100", "reflection", million, 9.8, 0.170},
    {"1x100", "reflection", 10 * million, {}, 1.46},
    {"10x100", "reflection", 10 * million, {}, 13.2},
    {"1x1", "reflection, diffraction", million, 0.966, {}},
    {"1x100", "reflection, diffraction", million, 11.5, {}},
};
constexpr uint64_t reference_diffraction_rays = 1'000'000;

struct Options {
  std::string device, shared = WAVETRACER_SHARED, only, peer, peer_paths, write_links;
  size_t frames = 7;
  uint64_t reference_rays = 30'000'000;
};

Place load_place(const std::string& shared) {
  if (const auto munich = munich_place(shared, most_transmitters, most_receivers)) return *munich;
  fmt::print(stderr,
             "bench_paths: munich is not in {}/scenes, so the generated city is used and there is no baseline\n",
             shared);
  return city_place(most_transmitters, most_receivers);
}

// Writes the input of bench/peers/sionna_rt.py, so that both solve the same links.
void write_links(const Place& place, const std::string& file) {
  nlohmann::ordered_json json{
      {"scene", place.name}, {"frequency_hz", config_of(place, 1, 1).radio.frequency_hz}, {"max_depth", max_depth}};
  for (const RadioEnd& end : place.transmitters) json["transmitters_m"].push_back(end.position_m);
  for (const RadioEnd& end : place.receivers) json["receivers_m"].push_back(end.position_m);
  std::ofstream out(file);
  out << json.dump(1) << "\n";
  if (!out.flush()) throw RuntimeError(fmt::format("cannot write {}: is its folder there, and writable?", file));
}

using Peer = std::map<std::tuple<std::string, uint64_t, std::string>, nlohmann::json>;  // by links, rays, interactions

Peer read_peer(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("cannot read {}, which --peer names", file));
  Peer peer;
  std::string line;
  for (size_t number = 1; std::getline(in, line); number++) {
    try {
      const auto json = nlohmann::json::parse(line);
      const auto interactions = json.at("interactions").get<std::vector<std::string>>();
      peer[{json.at("links"), json.at("rays"), fmt::format("{}", fmt::join(interactions, ", "))}] = {
          {"name", json.at("device")}, {"seconds", json.at("value").get<double>()}, {"paths", json.at("paths")}};
    } catch (const nlohmann::json::exception& error) {
      throw InputError(
          fmt::format("{}:{}: {}; expected a line of bench/peers/sionna_rt.py", file, number, error.what()));
    }
  }
  return peer;
}

Simulation make_simulation(const Place& place, const Case& c, const std::string& device) {
  Config config = config_of(place, c.transmitters, c.receivers);
  config.trace.rays = c.rays;
  config.trace.max_depth = max_depth;
  config.trace.diffraction = c.diffraction();
  config.trace.free_edges = false;
  config.trace.diffraction_rays = c.diffraction_rays;
  Simulation simulation(config, device);
  simulation.profile_every(1'000'000);  // no stages are printed, so only first frames are profiled
  return simulation;
}

// Returns the paths of many more rays.
reference::Case make_reference(const Place& place, Case c, const Options& options) {
  c.rays = std::max(c.rays, options.reference_rays);
  if (c.diffraction()) c.diffraction_rays = std::max(c.diffraction_rays, reference_diffraction_rays);
  reference::Case result;
  result.name = c.links();
  result.paths = make_simulation(place, c, options.device).run_frame(0).paths;
  return result;
}

std::optional<double> measured_peer(const Case& c, bool gpu) {
  for (const MeasuredPeer& peer : measured_peers)
    if (peer.links == c.links() && peer.interactions == c.interactions() && peer.rays == c.peer_rays)
      return gpu ? peer.gpu_s : peer.cpu_s;
  return {};
}

void set_baseline(Result& result, const Case& c, const Place& place, const Peer& peer, bool gpu) {
  if (!peer.empty()) {
    const auto found = peer.find({c.links(), c.peer_rays, c.interactions()});
    if (found == peer.end()) return;
    const nlohmann::json& line = found->second;
    result.baseline =
        fmt::format("{}, {:.0e} rays", line.at("name").get<std::string>(), static_cast<double>(c.peer_rays));
    result.baseline_value = line.at("seconds");
    result.extra["baseline_paths"] = line.at("paths");
    result.detail += fmt::format("; the baseline finds {} paths", line.at("paths").get<uint64_t>());
  } else if (const auto seconds = measured_peer(c, gpu); seconds && place.name == "munich") {
    result.baseline = fmt::format("Sionna RT 2.2.0 on {}, {:.0e} rays, {}", gpu ? "an H200" : "a 2-core CPU",
                                  static_cast<double>(c.peer_rays), c.diffraction() ? "2026-11-22" : "2026-11-21");
    result.baseline_value = seconds;
  }
}

// Tells whether path i has a diffraction that is on no wedge of the scene.
bool off_wedges(const Paths& paths, size_t i, const Scene& scene) {
  constexpr double tolerance_m = 0.05;  // float32 points are accurate to some millimetres
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; k++) {
    if (paths.vertex_interaction[k] != diffraction) continue;
    const glm::dvec3 point = paths.vertex_position_m[k] - scene.origin_m;
    if (std::ranges::none_of(scene.wedges, [&](const Wedge& wedge) {
          const double along_m = std::clamp(glm::dot(point - wedge.start, wedge.along), 0.0, wedge.length_m);
          return glm::distance(point, wedge.start + along_m * wedge.along) < tolerance_m;
        }))
      return true;
  }
  return false;
}

// Counts the peer's paths for this case that are among ours. The peer handles every mesh by itself, so it also
// diffracts at joints of touching houses, where their walls together leave no sector of free space wider than pi.
void compare_with_peer(Result& result, const Case& c, const Paths& paths, const Scene& scene,
                       const std::string& folder) {
  const fs::path file = fs::path(folder) / fmt::format("{}_{}_{}.json", c.links(), c.peer_rays,
                                                       c.diffraction() ? "reflection_diffraction" : "reflection");
  if (folder.empty() || !fs::exists(file)) return;
  const reference::Case theirs = reference::load_case(file);
  const reference::Comparison comparison = reference::compare_paths(theirs, paths);
  for (const auto& [kind, agreement] : comparison.kinds) {
    result.detail += fmt::format("; {} of the baseline's {} {} paths, {} more", agreement.found, agreement.reference,
                                 kind, agreement.extra);
    result.extra["baseline_recall"][kind] = agreement.recall;
    result.extra["baseline_power_recall"][kind] = agreement.power_recall;
  }
  if (!c.diffraction()) return;
  const auto off =
      std::ranges::count_if(comparison.missing, [&](size_t i) { return off_wedges(theirs.paths, i, scene); });
  result.detail += fmt::format("; {} of the {} others are at no wedge", off, comparison.missing.size());
  result.extra["baseline_missing"] = comparison.missing.size();
  result.extra["baseline_missing_off_wedges"] = off;
}

std::string name_of(const Case& c, const Place& place, uint64_t reference_rays) {
  std::string name =
      fmt::format("{}, {} links, {:.0e} rays per transmitter", place.name, c.links(), static_cast<double>(c.rays));
  if (c.diffraction())
    name += fmt::format(", diffraction, {:.0e} rays per receiver", static_cast<double>(c.diffraction_rays));
  return fmt::format("{}, error against {:.0e}", name, static_cast<double>(reference_rays));
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
  std::map<std::string, reference::Case> references;  // by links and interactions
  for (const Case& c : cases) {
    if (!options.only.empty() && (options.only == "diffraction") != c.diffraction()) continue;
    Simulation simulation = make_simulation(place, c, options.device);
    const Frames frames = run_frames(simulation, options.frames);
    reference::Case& reference = references[c.links() + c.interactions()];
    if (reference.name.empty()) reference = make_reference(place, c, options);
    const reference::Comparison comparison = reference::compare_paths(reference, frames.result.paths);

    Result result{"paths",
                  name_of(c, place, options.reference_rays),
                  simulation.device().name,
                  frames.median_s,
                  "s per frame",
                  Better::lower,
                  "",
                  {},
                  comparison.reference > 0 ? 1 - comparison.recall : 0,
                  fmt::format("{} paths of {}; {:.6f} of the power; first frame {:.3f} s", comparison.mine,
                              comparison.reference, comparison.power_recall, frames.first_s)};
    result.extra = {{"links", c.links()},
                    {"rays", c.rays},
                    {"paths", comparison.mine},
                    {"reference_paths", comparison.reference},
                    {"power_recall", comparison.power_recall},
                    {"first_frame_s", frames.first_s}};
    if (c.diffraction()) {
      result.extra["interactions"] = c.interactions();
      result.extra["diffraction_rays"] = c.diffraction_rays;
    }
    set_baseline(result, c, place, peer, gpu);
    compare_with_peer(result, c, frames.result.paths, simulation.scene(), options.peer_paths);
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
  app.add_option("--reference-rays", options.reference_rays, "rays per transmitter of the launch that errors refer to");
  app.add_option("--only", options.only, "reflection: no case with diffraction; diffraction: no other")
      ->check(CLI::IsMember({"reflection", "diffraction"}));
  app.add_option("--peer", options.peer, "lines printed by bench/peers/sionna_rt.py: the baseline of this machine");
  app.add_option("--peer-paths", options.peer_paths, "folder that its --paths has filled: how many of them are found");
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
