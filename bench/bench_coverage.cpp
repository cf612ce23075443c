// SPDX-License-Identifier: Apache-2.0
// bench_coverage measures receivers per second of coverage maps, with reflections to depth 3, and the longest stages.
// The machine must be quiet. "error" is the share of receivers whose power is wrong by more than 0.1 dB, or that have
// no path although ten times the rays find paths to them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "frames.hpp"
#include "json_line.hpp"
#include "places.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t max_depth = 3;
constexpr double wrong_db = 0.1;

struct Options {
  std::string device, shared = WAVETRACER_SHARED, peer, write_grid;
  size_t frames = 3;
  uint64_t rays = 1'000'000;
  double side_m = 300, step_m = 2;
  bool quick = false;
};

// Makes a square around the transmitter, with a receiver in the middle of every cell.
Config config_of(const Place& place, const Options& options, uint64_t rays) {
  Config config = config_of(place, 1, 0);
  config.trace.rays = rays;
  config.trace.max_depth = max_depth;
  const auto& centre = config.transmitters[0].position_m;
  ReceiverGridConfig& grid = config.receiver_grids.emplace_back();
  grid.name = "map";
  grid.x_min_m = centre[0] - options.side_m / 2;
  grid.x_max_m = centre[0] + options.side_m / 2;
  grid.y_min_m = centre[1] - options.side_m / 2;
  grid.y_max_m = centre[1] + options.side_m / 2;
  grid.step_m = options.step_m;
  return config;
}

std::vector<double> powers(const FrameResult& frame) {
  std::vector<double> out(frame.world.receivers.size(), 0);
  for (size_t i = 0; i < frame.paths.size(); ++i)
    for (const auto& a : frame.paths.a[i]) out[frame.paths.rx[i]] += std::norm(a);
  return out;
}

struct CoverageError {
  // Receivers with a path in the reference, of these without a path here, of these wrong by wrong_db.
  size_t heard = 0, lost = 0, wrong = 0;
  double mean_db = 0;  // for those that have paths in both
};

CoverageError compare(const std::vector<double>& reference, const std::vector<double>& mine) {
  CoverageError out;
  for (size_t i = 0; i < reference.size(); ++i) {
    if (!(reference[i] > 0)) continue;
    ++out.heard;
    if (!(mine[i] > 0)) {
      ++out.lost;
      continue;
    }
    const double off_db = std::abs(10 * std::log10(mine[i] / reference[i]));
    out.mean_db += off_db;
    out.wrong += off_db > wrong_db;
  }
  out.mean_db /= static_cast<double>(std::max<size_t>(out.heard - out.lost, 1));
  return out;
}

std::string stages(const StageSeconds& seconds) {
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [stage, s] : seconds)
    if (stage != "frame") sorted.emplace_back(s, stage);
  std::sort(sorted.rbegin(), sorted.rend());
  std::string out;
  for (size_t i = 0; i < std::min<size_t>(sorted.size(), 5); ++i)
    out += fmt::format("{}{} {:.3g} s", i == 0 ? "" : ", ", sorted[i].second, sorted[i].first);
  return out;
}

// The speed of another program at the same map, and the share of its cells that are wrong.
struct Peer {
  std::string name;
  double receivers_s = 0;
};

// Reads lines of bench/peers/sionna_radio_map.py for this scene, if --peer has some.
std::vector<Peer> read_peers(const std::string& file, const std::string& scene) {
  std::vector<Peer> peers;
  if (file.empty()) return peers;
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("cannot read {}, which --peer names", file));
  std::string line;
  for (size_t number = 1; std::getline(in, line); number++) {
    try {
      const auto json = nlohmann::json::parse(line);
      if (json.at("scene") != scene) continue;
      peers.push_back({fmt::format("{}, {:.0e} rays: {:.0f}% of its cells off by more than 0.1 dB",
                                   json.at("device").get<std::string>(), json.at("rays").get<double>(),
                                   100 * json.at("error").get<double>()),
                       json.at("value").get<double>()});
    } catch (const nlohmann::json::exception& error) {
      throw InputError(
          fmt::format("{}:{}: {}; expected a line of bench/peers/sionna_radio_map.py", file, number, error.what()));
    }
  }
  return peers;
}

void run_case(const Place& place, const Options& options, const std::string& command) {
  Simulation simulation(config_of(place, options, options.rays), options.device);
  const Frames frames = run_frames(simulation, options.frames);
  const size_t receivers = frames.result.world.receivers.size();
  const FrameResult reference = Simulation(config_of(place, options, 10 * options.rays), options.device).run_frame(0);
  const CoverageError error = compare(powers(reference), powers(frames.result));
  Result result{
      "coverage",
      fmt::format("{}, {} receivers, {:.0e} rays, depth {}, error against 10 times the rays", place.name, receivers,
                  static_cast<double>(options.rays), max_depth),
      simulation.device().name,
      static_cast<double>(receivers) / frames.median_s,
      "receivers/s",
      Better::higher,
      "",
      {},
      static_cast<double>(error.lost + error.wrong) / static_cast<double>(std::max<size_t>(error.heard, 1)),
      fmt::format("{} paths; {} receivers heard, {} lost, mean error {:.2g} dB; {}", frames.result.paths.size(),
                  error.heard, error.lost, error.mean_db, stages(frames.result.seconds))};
  result.extra = {{"receivers", receivers},
                  {"rays", options.rays},
                  {"frame_s", frames.median_s},
                  {"paths", frames.result.paths.size()},
                  {"candidates", frames.result.counts.candidates},
                  {"receivers_lost", error.lost},
                  {"mean_error_db", error.mean_db},
                  {"stage_s", frames.result.seconds}};
  const std::vector<Peer> peers = read_peers(options.peer, place.name);
  if (peers.empty()) print(result, command);
  const std::string name = result.name;
  for (const Peer& peer : peers) {
    result.name = name + (&peer == &peers.front() ? "" : fmt::format(" ({})", &peer - peers.data() + 1));
    result.baseline = peer.name;
    result.baseline_value = peer.receivers_s;
    print(result, command);
  }
}

// Writes the input of bench/peers/sionna_radio_map.py, so that both compute the same map.
void write_grid(const Place& place, const Options& options) {
  const Config config = config_of(place, options, options.rays);
  const nlohmann::ordered_json json{
      {"scene", place.name},      {"frequency_hz", config.radio.frequency_hz},          {"max_depth", max_depth},
      {"rays", options.rays},     {"transmitter_m", config.transmitters[0].position_m}, {"side_m", options.side_m},
      {"step_m", options.step_m}, {"height_m", ReceiverGridConfig::default_height_m}};
  std::ofstream out(options.write_grid);
  out << json.dump(1) << "\n";
  if (!out.flush())
    throw RuntimeError(fmt::format("cannot write {}: is its folder there, and writable?", options.write_grid));
}

void run(Options options, const std::string& command) {
  if (options.quick) {
    options.frames = 1;
    options.rays = std::min<uint64_t>(options.rays, 100'000);
    options.step_m = std::max(options.step_m, 5.0);
  }
  std::vector<Place> places;
  if (const auto munich = munich_place(options.shared, 1, 1)) places.push_back(*munich);
  places.push_back(city_place(1, 1));
  if (!options.write_grid.empty()) return write_grid(places.front(), options);
  for (const Place& place : places) run_case(place, options, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Receivers a second of coverage maps in munich and in a generated city");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich/munich.xml");
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(1, 1000));
  app.add_option("--rays", options.rays, "of the transmitter")->check(CLI::Range(1, 200'000'000));
  app.add_option("--side", options.side_m, "of the square map, in metres")->check(CLI::PositiveNumber);
  app.add_option("--step", options.step_m, "of the map, in metres")->check(CLI::PositiveNumber);
  app.add_flag("--quick", options.quick, "a coarse map, few rays, one frame");
  app.add_option("--peer", options.peer, "lines printed by bench/peers/sionna_radio_map.py: the baselines");
  app.add_option("--write-grid", options.write_grid, "write the map's place for that program to this file, and end");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_coverage: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
