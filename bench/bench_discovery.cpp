// SPDX-License-Identifier: Apache-2.0
// bench_discovery measures how many rays are needed for a recall, on streets of munich: plain launches, rays = "auto",
// and frames of a drive that keep the sequences of earlier ones. It needs the reference lists of munich; "error" is 1 -
// path recall.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <glm/geometric.hpp>

#include "frames.hpp"
#include "json_line.hpp"
#include "reference/compare.hpp"
#include "scene/load.hpp"
#include "street_traffic.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;
using reference::Comparison;

const char* const case_names[] = {"munich_street_0", "munich_street_1", "munich_street_2", "munich_street_deep"};
constexpr double enough_paths = 0.99, enough_power = 0.9999;
constexpr double step_s = 0.1, speed_m_s = 10;
constexpr uint32_t drive_frames = 10;
constexpr uint64_t refresh_share = 20;  // each later frame launches the first frame's rays divided by this

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> cases{std::begin(case_names), std::end(case_names)};
  size_t frames = 3, ways = 4;
  uint64_t most_rays = 1'000'000;
};

// Returns 1, 1.5, 2, 3, 5, 7 times powers of ten.
std::vector<uint64_t> launch_sizes(uint64_t most) {
  std::vector<uint64_t> sizes;
  for (uint64_t decade = 1000; decade <= most; decade *= 10)
    for (const uint64_t tenths : {10, 15, 20, 30, 50, 70})
      if (const uint64_t rays = decade / 10 * tenths; rays <= most) sizes.push_back(rays);
  return sizes;
}

RadioEnd end_at(const std::string& name, const glm::dvec3& p) {
  return {.name = name, .position_m = {p.x, p.y, p.z}, .polarization = "VH"};
}

bool suffices(const Comparison& c) { return c.recall >= enough_paths && c.power_recall >= enough_power; }

class Bench {
 public:
  Bench(const Options& options, const std::string& name, const fs::path& list, std::string command)
      : options_(options), name_(name), reference_(reference::load_case(list)), command_(std::move(command)) {
    config_.scene.file =
        (fs::path(options.shared) / "scenes" / reference_.scene / (reference_.scene + ".xml")).string();
    config_.radio.frequency_hz = reference_.frequency_hz;
    config_.trace.max_depth = reference_.max_depth;
    for (const glm::dvec3& p : reference_.receivers_m)
      config_.receivers.push_back(end_at(fmt::format("rx{}", config_.receivers.size()), p));
  }

  void run() {
    const uint64_t plain = find_plain();
    for (const double recall : {0.99, 0.999, 0.9999}) run_auto(recall, plain);
    for (const double recall : {0.99, 0.999})
      print_reuse(drive(0, recall), fmt::format("auto, recall {}", recall), plain);
    find_reuse(plain);
  }

 private:
  struct Measured {
    Comparison comparison = {};
    uint64_t rays = 0;
    double seconds = 0, worst = 1;  // worst: lowest path recall over the ways
  };

  Measured solve_standing(const Config& config) {
    Simulation simulation(config, options_.device);
    device_ = simulation.device().name;
    const Frames frames = run_frames(simulation, options_.frames);
    return {reference::compare_paths(reference_, frames.result.paths), frames.result.counts.rays, frames.median_s};
  }

  Config standing() const {
    Config config = config_;
    config.transmitters.push_back(end_at("tx", reference_.transmitters_m.front()));
    return config;
  }

  // Returns the smallest launch that suffices together with all larger ones, or the largest if none does.
  uint64_t find_plain() {
    Config config = standing();
    const std::vector<uint64_t> sizes = launch_sizes(options_.most_rays);
    std::vector<Measured> launches;
    for (const uint64_t rays : sizes) {
      config.trace.rays = rays;
      launches.push_back(solve_standing(config));
      const Comparison& c = launches.back().comparison;
      fmt::print(stderr, "{}: {} rays: {:.4f} of the paths, {:.6f} of the power\n", name_, rays, c.recall,
                 c.power_recall);
    }
    size_t chosen = launches.size() - 1;
    while (chosen > 0 && suffices(launches[chosen].comparison) && suffices(launches[chosen - 1].comparison)) chosen--;
    const auto first =
        std::find_if(launches.begin(), launches.end(), [](const Measured& m) { return suffices(m.comparison); });
    Measured plain = launches[chosen];
    plain.rays = sizes[chosen];
    print_line(plain, "plain", 0,
               !suffices(plain.comparison) ? "not enough, and no more were tried"
               : first->rays < plain.rays  ? fmt::format("{} were enough by luck", first->rays)
                                           : "no fewer were enough");
    return plain.rays;
  }

  void run_auto(double recall, uint64_t plain) {
    Config config = standing();
    config.trace.rays = {};
    config.trace.recall = recall;
    print_line(solve_standing(config), fmt::format("auto, recall {}", recall), plain, "");
  }

  // Finds the fewest rays per frame, a twentieth of those of the first frame, that suffice together with the next
  // larger number.
  void find_reuse(uint64_t plain) {
    std::optional<Measured> fewest;
    for (const uint64_t rays : launch_sizes(options_.most_rays / refresh_share)) {
      const Measured more = drive(refresh_share * rays, 0);
      fmt::print(stderr, "{}: {} rays per frame of a drive: {:.4f} of the paths, {:.6f} of the power\n", name_, rays,
                 more.comparison.recall, more.comparison.power_recall);
      if (suffices(more.comparison) && fewest) break;
      fewest.reset();
      if (suffices(more.comparison)) fewest = more;
    }
    if (fewest)
      print_reuse(*fewest, fmt::format("{} rays at first", refresh_share * fewest->rays), plain);
    else
      fmt::print(stderr, "{}: no drive sufficed, and no more rays were tried\n", name_);
  }

  void print_reuse(const Measured& mean, const std::string& what, uint64_t plain) const {
    print_line(mean, "reuse, " + what, plain,
               fmt::format("frame {} of {} ways; {:.4f} at worst", drive_frames - 1, ways_.size(), mean.worst));
  }

  // The transmitter drives and ends at its place in the list. rays: those of the first frame, of which later ones
  // launch a share, or 0: "auto" for this recall. Recall and rays are means over several ways to that place, and rays
  // over the frames after the first.
  Measured drive(uint64_t rays, double recall) {
    const double length_m = (drive_frames - 1) * step_s * speed_m_s;
    const glm::dvec3 end_m = reference_.transmitters_m.front();
    Config config = config_;
    config.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 1, .width_m = 1, .height_m = 1}};
    config.mounts = {{.name = "tx", .role = "transmitter", .polarization = "VH"}};
    config.time.step_s = step_s;
    config.trace.rays = rays;
    config.trace.recall = recall;
    config.trace.refresh_rays = rays / refresh_share;
    if (ways_.empty()) ways_ = free_ways_to(load_scene(config), end_m, length_m, options_.ways);
    Measured mean;
    uint64_t launched = 0;
    for (const glm::dvec3& start_m : ways_) {
      config.tracks = {
          {"drive",
           "antenna",
           {{0, start_m.x, start_m.y, start_m.z}, {(drive_frames - 1) * step_s, end_m.x, end_m.y, end_m.z}}}};
      Simulation simulation(config, options_.device);
      FrameResult result;
      for (uint32_t frame = 0; frame < drive_frames; frame++) {
        result = simulation.run_frame(frame);
        if (frame > 0) launched += result.counts.rays;
      }
      const Comparison c = reference::compare_paths(reference_, result.paths);
      const double weight = 1 / static_cast<double>(ways_.size());
      mean.comparison.reference = c.reference;
      mean.comparison.found += c.found;
      mean.comparison.recall += weight * c.recall;
      mean.comparison.power_recall += weight * c.power_recall;
      mean.seconds += weight * result.seconds.at("frame");
      mean.worst = std::min(mean.worst, c.recall);
    }
    mean.comparison.found /= ways_.size();
    mean.rays = launched / (ways_.size() * (drive_frames - 1));
    return mean;
  }

  // plain: 0 if this is the plain launch itself.
  void print_line(const Measured& measured, const std::string& what, uint64_t plain, const std::string& remark) const {
    const Comparison& c = measured.comparison;
    Result line;
    line.bench = "discovery";
    line.name = fmt::format("{}, {}", name_, what);
    line.device = device_;
    line.value = static_cast<double>(measured.rays);
    line.unit = "rays per frame";
    line.better = Better::lower;
    if (plain > 0) {
      line.baseline = "a plain launch that suffices";
      line.baseline_value = static_cast<double>(plain);
    }
    line.error = 1 - c.recall;
    line.detail = fmt::format("{} of {} paths, {:.6f} of the power, {:.4g} s{}{}", c.found, c.reference, c.power_recall,
                              measured.seconds, remark.empty() ? "" : "; ", remark);
    line.extra = {{"rays", measured.rays},
                  {"path_recall", c.recall},
                  {"power_recall", c.power_recall},
                  {"frame_s", measured.seconds}};
    print(line, command_);
  }

  const Options& options_;
  std::string name_;
  reference::Case reference_;
  std::string command_, device_;
  Config config_;                 // without the transmitter
  std::vector<glm::dvec3> ways_;  // starts of drives
};

void run(const Options& options, const std::string& command) {
  for (const std::string& name : options.cases) {
    const fs::path list = fs::path(options.shared) / "oracle" / (name + ".json");
    if (!fs::exists(list)) {
      fmt::print(stderr, "bench_discovery: {} is not there, so {} is skipped; --shared names its folder\n",
                 list.string(), name);
      continue;
    }
    Bench(options, name, list, command).run();
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("The rays that recall takes: plain launches, rays = \"auto\", and drives that keep sequences");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds oracle/munich_*.json and scenes/munich");
  app.add_option("--cases", options.cases, "some of the lists")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(bench::case_names), std::end(bench::case_names))));
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(1, 1000));
  app.add_option("--ways", options.ways, "drives over which the recall with reuse is averaged")
      ->check(CLI::Range(1, 24));
  app.add_option("--most-rays", options.most_rays, "of plain launches")->check(CLI::Range(10'000, 2'000'000'000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_discovery: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
