// SPDX-License-Identifier: Apache-2.0
// bench_order measures the gain of ordering rays, including the time of the sort: every method of order.method, at
// launch and before each depth, launch shapes, and rays born in order, against random directions unordered. The machine
// must be quiet, with device memory for all of them at once. "error" counts paths that differ from those of the
// unordered launch; for rays born in order, which have other directions, it counts paths that they miss among those
// that either finds.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <filesystem>
#include <set>

#include "json_line.hpp"
#include "timing.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t max_depth = 7;

struct Options {
  std::string device, scene;
  size_t runs = 7;
  uint64_t rays = 0;  // 0 means a number that suits the device
};

struct Place {
  std::string name, file, generate;  // file or generate is set
  std::array<double, 3> transmitter_m, receiver_m;
};

// The places are Munich with the transmitter of bench_trace and a car of configs/munich.toml, and the city with
// antennas of configs/city.toml.
std::vector<Place> places(const std::string& scene) {
  std::vector<Place> result;
  const std::string munich = WAVETRACER_SHARED "/scenes/munich/munich.xml";
  if (scene != "city") {
    if (std::filesystem::exists(munich))
      result.push_back({"munich", munich, "", {45, 90, 1.5}, {14.927, 35.708, 1.5}});
    else if (scene == "munich")
      throw InputError(fmt::format("{} is not there; --scene city needs no file", munich));
    else
      fmt::print(stderr, "bench_order: {} is not there, so only the generated city is traced\n", munich);
  }
  if (scene != "munich") result.push_back({"demo city", "", "--seed 1 --blocks 6x6", {8, 8, 6}, {60, -3, 1.5}});
  return result;
}

struct Variant {
  std::string method = "none", directions = "random", shape = "auto";
  bool each_depth = false;
  uint32_t bins = 16;
};

// The unordered launch comes first.
std::vector<Variant> variants() {
  std::vector<Variant> all{{}};
  for (const char* method : {"morton", "hilbert3d-histogram", "morton-histogram", "hilbert3d-histogram-hilbert2d",
                             "hilbert3d-histogram-hilbert3d", "direction-origin"})
    for (const bool each_depth : {false, true}) all.push_back({.method = method, .each_depth = each_depth});
  for (const uint32_t bins : {32u, 64u}) all.push_back({.method = "hilbert3d-histogram", .bins = bins});
  for (const char* method : {"none", "hilbert3d-histogram"})
    for (const char* shape : {"2d", "3d"}) all.push_back({.method = method, .shape = shape});
  all.push_back({.directions = "hilbert"});
  return all;
}

std::string label(const Variant& v) {
  std::string text = v.directions == "hilbert" ? "born in order" : v.method;
  if (v.method.find("histogram") != std::string::npos) text += fmt::format(", {} bins", v.bins);
  if (v.each_depth) text += ", each depth";
  if (v.shape != "auto") text += fmt::format(", launched in {}", v.shape);
  return text;
}

Config config_of(const Place& place, const Variant& variant, uint64_t rays) {
  Config config;
  config.scene.file = place.file;
  config.scene.generate = place.generate;
  config.trace.rays = rays;
  config.trace.max_depth = max_depth;
  config.trace.directions = Directions::named(variant.directions);
  config.order = {OrderMethod::named(variant.method), variant.each_depth, variant.bins};
  config.launch.shape = LaunchDimensions::named(variant.shape);
  config.transmitters = {{.name = "tx", .position_m = place.transmitter_m}};
  config.receivers = {{.name = "rx", .position_m = place.receiver_m}};
  return config;
}

// A path as the bits of its numbers.
using PathBits = std::vector<uint64_t>;

std::multiset<PathBits> bits_of(const Paths& paths) {
  std::multiset<PathBits> all;
  for (size_t i = 0; i < paths.size(); i++) {
    PathBits bits{paths.tx[i], paths.rx[i], paths.depth[i]};
    for (const double value :
         {paths.delay_s[i], paths.gain_db[i], paths.a[i][0].real(), paths.a[i][0].imag(), paths.aod_theta_rad[i],
          paths.aod_phi_rad[i], paths.aoa_theta_rad[i], paths.aoa_phi_rad[i]})
      bits.push_back(std::bit_cast<uint64_t>(value));
    for (size_t j = paths.vertex_offset[i]; j < paths.vertex_offset[i + 1]; j++) {
      bits.push_back(paths.vertex_surface[j]);
      for (int axis = 0; axis < 3; axis++) bits.push_back(std::bit_cast<uint64_t>(paths.vertex_position_m[j][axis]));
    }
    all.insert(std::move(bits));
  }
  return all;
}

// Returns how many of a are not in b.
size_t missing(const std::multiset<PathBits>& a, const std::multiset<PathBits>& b) {
  std::vector<PathBits> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest.size();
}

struct Subject {
  Variant variant;
  Simulation simulation;
  std::multiset<PathBits> paths;
  std::vector<double> paid, unpaid, trace, order;  // milliseconds of each run
};

// Runs rounds over all of them, each starting with another one, so that a slow phase of the machine affects them all
// and no variant always follows the same one.
std::vector<Subject> measure(const Place& place, uint64_t rays, const Options& options) {
  std::vector<Subject> subjects;
  for (const Variant& variant : variants()) {
    subjects.push_back({variant, Simulation(config_of(place, variant, rays), options.device), {}, {}, {}, {}, {}});
    subjects.back().paths = bits_of(subjects.back().simulation.run_frame(0).paths);
  }
  for (size_t run = 0; run < options.runs; run++)
    for (size_t i = 0; i < subjects.size(); i++) {
      Subject& s = subjects[(run + i) % subjects.size()];
      const StageSeconds seconds = s.simulation.run_frame(0).seconds;
      s.trace.push_back(1e3 * stage_seconds(seconds, Stage::trace));
      s.order.push_back(1e3 * part_seconds(seconds, FramePart::order));
      s.unpaid.push_back(1e3 * part_seconds(seconds, FramePart::discovery));
      s.paid.push_back(s.unpaid.back() + s.order.back());
    }
  return subjects;
}

double median_ratio(const std::vector<double>& baseline, const std::vector<double>& ours) {
  std::vector<double> ratios;
  for (size_t run = 0; run < ours.size(); run++) ratios.push_back(baseline[run] / ours[run]);
  return median(ratios);
}

void print_place(const Place& place, uint64_t rays, const std::vector<Subject>& subjects, const std::string& command) {
  const Subject& unordered = subjects.front();
  for (const Subject& s : subjects) {
    const bool same_rays = s.variant.directions == unordered.variant.directions;
    const size_t missed = missing(unordered.paths, s.paths), added = missing(s.paths, unordered.paths);
    Result result;
    result.bench = "order";
    result.name = fmt::format("{}, {} rays: {}", place.name, rays, label(s.variant));
    result.device = s.simulation.device().name;
    result.value = median(s.paid);
    result.unit = "ms";
    result.better = Better::lower;
    result.error = static_cast<double>(same_rays ? missed + added : missed);
    result.exact = same_rays;
    const double unpaid = median(s.unpaid), trace = median(s.trace), order = median(s.order);
    result.detail = fmt::format("order and sort {:.3g} ms, trace {:.3g} ms; {} paths", order, trace, s.paths.size());
    if (!same_rays) result.detail += fmt::format(", {} that the random launch misses", added);
    result.extra = {{"rays", rays},      {"max_depth", max_depth},  {"unpaid_ms", unpaid},  {"trace_ms", trace},
                    {"order_ms", order}, {"paths", s.paths.size()}, {"runs", s.paid.size()}};
    if (&s != &unordered) {
      result.baseline = "random directions, unordered";
      result.baseline_value = median(unordered.paid);
      result.extra["ratio_unpaid"] = median(unordered.unpaid) / unpaid;
      result.extra["ratio_trace"] = median(unordered.trace) / trace;
      result.extra["ratio_trace_paid"] = median(unordered.trace) / (trace + order);
      result.detail +=
          fmt::format("; tracing alone, sort paid: {:.2f} times", median(unordered.trace) / (trace + order));
      result.extra["median_ratio"] = median_ratio(unordered.paid, s.paid);
    }
    print(result, command);
  }
}

void run(const Options& options, const std::string& command) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const bool cpu = devices[gpu::choose_device(devices, options.device)].cpu;
  const uint64_t rays = options.rays ? options.rays : cpu ? 1'000'000 : uint64_t{1} << 24;
  for (const Place& place : places(options.scene)) print_place(place, rays, measure(place, rays, options), command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Measures the gain of orders of rays over a random launch, with the time of the sort");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--runs", options.runs, "timed frames of which the median counts")->check(CLI::Range(7, 1000));
  app.add_option("--rays", options.rays, "launched rays; default: 1e6 on CPUs, 2^24 elsewhere");
  app.add_option("--scene", options.scene, "one of the two scenes alone")->check(CLI::IsMember({"munich", "city"}));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_order: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
