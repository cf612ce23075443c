// SPDX-License-Identifier: Apache-2.0
// bench_cached_frame compares frames of a moving world with and without ray caches: seconds, their stages, and losses.
// The scene is Munich with moving cars; the transmitter stands at a crossing, or rides on a car. No frame reuses
// sequences, except in the case that says so. "error" is the lost power against uncached frames of the same rays.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>

#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "scene/load.hpp"
#include "street.hpp"
#include "street_traffic.hpp"
#include "study/path_error.hpp"
#include "timing.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

constexpr double step_s = 0.04, height_m = 1.5, radius_m = 300;
const glm::dvec3 crossing_m(45, 90, height_m);
constexpr size_t receivers = 10;

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<uint64_t> rays;
  std::vector<std::string> transmitters{"standing", "riding"};
  uint32_t frames = 12, vehicles = 0;
  bool quick = false;
  gpu::DeviceInfo info;
};

struct Setting {
  std::string name;
  std::function<void(Config&)> change;
};

struct Measured {
  double frame_s = 0;
  StageSeconds stages;  // medians
  study::PathError error;
  double hit_share = 0, hit_share_late = 0;  // for all segments, and for those after the first
  uint64_t used = 0, dropped = 0;
};

Config world(const Options& options, bool riding) {
  Config config;
  config.scene.file = (std::filesystem::path(options.shared) / "scenes" / "munich" / "munich.xml").string();
  config.time = {.start_s = 0, .end_s = (options.frames - 1) * step_s, .step_s = step_s};
  const Scene scene = load_scene(config);
  std::vector<glm::dvec3> points = street_points(scene, crossing_m, radius_m, height_m, receivers);
  for (size_t i = 0; i < points.size(); ++i)
    config.receivers.push_back({.name = fmt::format("rx{}", i), .position_m = {points[i].x, points[i].y, points[i].z}});
  points.push_back(crossing_m);
  config.tracks = street_traffic(scene, {.vehicles = options.vehicles,
                                         .duration_s = std::max(options.frames - 1, 1u) * step_s,
                                         .centre_m = crossing_m,
                                         .radius_m = radius_m,
                                         .standing_m = points});
  if (riding)
    config.mounts = {{.name = "roof", .on = config.tracks.front().id, .role = "transmitter", .offset_m = {0, 0, 1.7}}};
  else
    config.transmitters = {{.name = "mast", .position_m = {crossing_m.x, crossing_m.y, crossing_m.z}}};
  config.trace.reuse = false;
  return config;
}

using Cache = std::function<void(CacheConfig&)>;

Setting cached(const std::string& name, uint64_t entries, const Cache& change) {
  return {name, [entries, change](Config& config) {
            config.cache.kind = "concurrent";
            config.cache.buffer_size = entries;
            change(config.cache);
          }};
}

std::vector<Setting> settings(const Options& options, uint64_t rays) {
  const uint64_t entries = std::min<uint64_t>(4 * rays, options.info.cpu ? 1 << 24 : uint64_t{1} << 27);
  const auto random = [](Config& config) { config.trace.directions = "random"; };
  const auto exact = [](uint32_t hash, uint32_t first_depth) {
    return [=](CacheConfig& cache) {
      cache.key = "exact";
      cache.hash_method = hash;
      cache.first_depth = first_depth;
    };
  };
  std::vector<Setting> all{
      {"no cache, random directions", random},
      {"no cache, sequences reused", [](Config& config) { config.trace.reuse = true; }},
      cached("exact, hash 1", entries, exact(1, 1)),
      cached("exact, hash 2", entries, exact(2, 1)),
      cached("exact, hash 1, from depth 2", entries, exact(1, 2)),
      cached("exact, hash 2, from depth 2", entries, exact(2, 2)),
  };
  const Setting unordered = cached("", entries, exact(1, 1));
  all.push_back({"exact, hash 1, random directions", [=](Config& config) {
                   random(config);
                   unordered.change(config);
                 }});
  for (uint32_t division = 100; division <= 1'000'000; division *= 10)
    all.push_back(cached(fmt::format("position, division {}", division), entries,
                         [=](CacheConfig& cache) { cache.division = division; }));
  all.push_back(cached("precision 0.0125, division 10000", entries, [](CacheConfig& cache) {
    cache.purge = "precision";
    cache.division = 10000;
  }));
  const auto thesis = [](CachePurging purge, uint32_t division) {
    return [=](CacheConfig& cache) {
      cache.kind = "open";
      cache.scope = "all";
      cache.hit_point = "cached";
      cache.hash_method = 1;
      cache.purge = purge;
      cache.division = division;
    };
  };
  all.push_back(cached("as the thesis: open, position, division 200000", entries, thesis("position", 200000)));
  all.push_back(cached("as the thesis: open, precision, division 10000", entries, thesis("precision", 10000)));
  if (options.quick) all.resize(4);
  return all;
}

// Runs all frames once to warm up, then once more: a drive that starts again meets the table that it left. If the
// transmitter stands, that is the steady state; if it rides, position keys have changed.
Measured measure(Config config, const Options& options, const std::vector<Paths>* reference, std::vector<Paths>* keep) {
  Simulation simulation(config, options.device);
  for (uint32_t frame = 0; frame < options.frames; ++frame) simulation.run_frame(frame);
  Measured out;
  std::vector<double> seconds;
  std::map<std::string, std::vector<double>> stages;
  study::PathErrorMean error;
  uint64_t lookups = 0, hits = 0, late = 0, late_hits = 0;
  for (uint32_t frame = 0; frame < options.frames; ++frame) {
    const FrameResult result = simulation.run_frame(frame);
    seconds.push_back(result.seconds.at("frame"));
    for (const auto& [stage, s] : result.seconds) stages[stage].push_back(s);
    if (reference) error.add(study::path_error((*reference)[frame], result.paths));
    if (keep) keep->push_back(result.paths);
    const CacheSummary& cache = result.cache;
    if (!cache.on) continue;
    lookups += cache.lookups;
    hits += cache.hits;
    late += cache.lookups - cache.lookups_per_depth[0];
    late_hits += cache.hits - cache.hits_per_depth[0];
    out.used = cache.used;
    out.dropped += cache.dropped;
  }
  out.frame_s = median(seconds);
  for (const auto& [stage, values] : stages) out.stages[stage] = median(values);
  if (reference) out.error = error.mean();
  out.hit_share = lookups ? static_cast<double>(hits) / static_cast<double>(lookups) : 0;
  out.hit_share_late = late ? static_cast<double>(late_hits) / static_cast<double>(late) : 0;
  return out;
}

double stage_ms(const Measured& measured, const std::string& stage) {
  const auto found = measured.stages.find(stage);
  return found == measured.stages.end() ? 0 : 1e3 * found->second;
}

void print_line(const Options& options, const std::string& name, const Measured& measured, const Measured* baseline,
                const std::string& command) {
  const study::PathError& error = measured.error;
  Result result{.bench = "cached_frame",
                .name = name,
                .device = options.info.name,
                .value = 1e3 * measured.frame_s,
                .unit = "ms/frame",
                .better = Better::lower,
                .baseline = "",
                .baseline_value = {},
                .detail = fmt::format("trace {:.2f} ms", stage_ms(measured, "trace"))};
  const double look_ms = stage_ms(measured, "cache_lookup");
  if (look_ms > 0)
    result.detail += fmt::format(", look-up {:.2f}, store {:.2f}, gather {:.2f}, vehicles {:.2f}; answered {:.1f}%",
                                 look_ms, stage_ms(measured, "cache_store"), stage_ms(measured, "cache_gather"),
                                 stage_ms(measured, "trace_moving"), 100 * measured.hit_share);
  if (baseline) {
    result.baseline = "no cache, in order";
    result.baseline_value = 1e3 * baseline->frame_s;
    result.error = error.lost_power;
    result.detail +=
        fmt::format("; paths lost {:.3f}%, spurious {:.3f}%", 100 * error.lost_share, 100 * error.spurious_share);
    result.extra["lost_paths"] = error.lost_share;
    result.extra["spurious_paths"] = error.spurious_share;
    result.extra["delay_spread_ns"] = error.delay_spread_ns;
  }
  result.extra["hit_share"] = measured.hit_share;
  result.extra["hit_share_late"] = measured.hit_share_late;
  result.extra["entries_used"] = measured.used;
  result.extra["dropped"] = measured.dropped;
  for (const auto& [stage, seconds] : measured.stages) result.extra["stages_ms"][stage] = 1e3 * seconds;
  print(result, command);
}

void run(Options& options, const std::string& command) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  options.info = devices[gpu::choose_device(devices, options.device)];
  if (options.vehicles == 0) options.vehicles = options.info.cpu ? 20 : 100;
  if (options.rays.empty())
    options.rays = options.info.cpu ? std::vector<uint64_t>{1'000'000} : std::vector<uint64_t>{1'000'000, 10'000'000};
  for (const std::string& transmitter : options.transmitters) {
    const Config base = world(options, transmitter == "riding");
    for (const uint64_t rays : options.rays) {
      const std::string name = fmt::format("munich, {} cars, {} transmitter, {:.0e} rays: ", options.vehicles,
                                           transmitter, static_cast<double>(rays));
      Config config = base;
      config.trace.rays = rays;
      std::vector<Paths> reference;
      const Measured baseline = measure(config, options, nullptr, &reference);
      print_line(options, name + "no cache, in order", baseline, nullptr, command);
      for (const Setting& setting : settings(options, rays)) {
        Config changed = config;
        setting.change(changed);
        print_line(options, name + setting.name, measure(changed, options, &reference, nullptr), &baseline, command);
      }
    }
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer::bench;
  Options options;
  CLI::App app{"Frames with ray caches against frames without: time, and what is lost"};
  app.add_option("--device", options.device, "part of a platform's or device's name, or an index");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich");
  app.add_option("--rays", options.rays, "rays per transmitter")->delimiter(',');
  app.add_option("--transmitters", options.transmitters, "standing, riding")
      ->delimiter(',')
      ->check(CLI::IsMember({"standing", "riding"}));
  app.add_option("--frames", options.frames, "frames of the drive")->check(CLI::Range(1, 1000));
  app.add_option("--vehicles", options.vehicles, "moving cars; 0: 100 on GPUs, 20 on CPUs");
  app.add_flag("--quick", options.quick, "the first settings only");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options, command_line(argc, argv));
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_cached_frame: {}\n", e.what());
    return 1;
  }
}
