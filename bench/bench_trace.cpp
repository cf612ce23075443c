// SPDX-License-Identifier: Apache-2.0
// bench_trace measures nearest hits of seven segments of specular bounces, with our kernels in every shape that the
// device has, and with Embree. The machine must be quiet. Ours and Embree get the same arrays of rays; "error" counts
// rays whose hit distance differs from that of Embree's robust mode (or of our first shape, if Embree is missing) by
// more than a millimetre and 1e-4 of it.
#include <fmt/format.h>
#include <array>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "accel/triangles.hpp"
#include "gpu/gpu.hpp"
#include "json_line.hpp"
#include "passes/device_scene.hpp"
#include "passes/generate_rays.hpp"
#include "passes/ray_queue.hpp"
#include "scene/city.hpp"
#include "scene/load.hpp"
#include "segments.hpp"
#include "timing.hpp"
#include "tracers.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr size_t kSegments = 7;

struct NamedTracer {
  std::string name;
  std::unique_ptr<Tracer> tracer;
};

struct Sample {
  std::array<double, kSegments> seconds{};
  size_t differing = 0;
};

using Segments = std::vector<std::vector<Ray>>;
using Truth = std::vector<std::vector<Hit>>;

// Returns the program's own launch rays: "random", or "hilbert", its default, in which neighbours have similar
// directions.
std::vector<Ray> launch(gpu::Context& context, Directions directions, std::array<float, 3> origin, size_t count) {
  RayQueue queue = make_ray_queue(context, count, "launch rays");
  GenerateRays(context, LaunchDirections(directions, count, 1))(queue, {0, {origin[0], origin[1], origin[2]}}, 0,
                                                                static_cast<uint32_t>(count));
  std::vector<Ray> rays(count, {origin, 0, {}, std::numeric_limits<float>::max()});
  for (size_t axis = 0; axis < 3; axis++) {
    const std::vector<float> plane = queue.planes.read((WT_RAY_DIRECTION + axis) * queue.capacity, count);
    for (size_t i = 0; i < count; i++) rays[i].direction[axis] = plane[i];
  }
  return rays;
}

struct Place {
  Scene scene;
  std::string name;
  std::array<double, 3> transmitter_m;
};

Place load_place(std::string file) {
  const std::string munich = WAVETRACER_SHARED "/scenes/munich/munich.xml";
  if (file.empty() && std::filesystem::exists(munich)) file = munich;
  if (!file.empty()) {
    return {load_scene_file(file, {}), std::filesystem::path(file).stem().string(), {45, 90, 1.5}};
  }
  fmt::print(stderr, "bench_trace: {} is not there, so the generated city is traced instead\n", munich);
  Config config;
  config.scene.generate = "--seed 1";
  return {load_scene(config), "city", example_positions(parse_city_options(config.scene.generate)).front().position_m};
}

std::vector<Hit> trace_once(Tracer& tracer, std::span<const Ray> rays) {
  std::vector<Hit> hits(rays.size());
  if (rays.empty()) return hits;
  tracer.load(rays);
  tracer.run();
  tracer.fetch(hits);
  return hits;
}

// Returns all segments from the launched rays on, and the hits that they should give, by following `truth`.
std::pair<Segments, Truth> make_segments(std::vector<Ray> launched, Tracer& truth,
                                         std::span<const AccelTriangle> triangles) {
  Segments segments{std::move(launched)};
  Truth hits;
  for (size_t s = 0; s < kSegments; s++) {
    hits.push_back(trace_once(truth, segments[s]));
    if (s + 1 < kSegments) segments.push_back(next_segment(segments[s], hits[s], triangles));
  }
  return {std::move(segments), std::move(hits)};
}

// Measures every tracer over every segment. Runs alternate between the tracers, so that a slow phase of the machine
// slows them all, and ratios of medians are meaningful.
std::vector<Sample> measure(std::span<const NamedTracer> tracers, const Segments& segments, const Truth& truth,
                            size_t runs) {
  std::vector<Sample> samples(tracers.size());
  for (size_t s = 0; s < kSegments; s++) {
    if (segments[s].empty()) continue;
    for (size_t i = 0; i < tracers.size(); i++) {
      const std::vector<Hit> hits = trace_once(*tracers[i].tracer, segments[s]);  // warms up; the rays stay loaded
      for (size_t ray = 0; ray < hits.size(); ray++) {
        const float expected = truth[s][ray].t;
        samples[i].differing += !(std::abs(hits[ray].t - expected) <= 1e-3f + 1e-4f * std::abs(expected));
      }
    }
    std::vector<std::vector<double>> seconds(tracers.size());
    for (size_t run = 0; run < runs; run++)
      for (size_t i = 0; i < tracers.size(); i++) seconds[i].push_back(tracers[i].tracer->run());
    for (size_t i = 0; i < tracers.size(); i++) samples[i].seconds[s] = median(seconds[i]);
  }
  return samples;
}

double sum(const std::array<double, kSegments>& seconds) {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

std::string rates(const Segments& segments, const std::array<double, kSegments>& seconds) {
  std::string text = "b0..b6:";
  for (size_t s = 0; s < kSegments; s++)
    text += seconds[s] > 0 ? fmt::format(" {:.1f}", static_cast<double>(segments[s].size()) / seconds[s] * 1e-6) : " -";
  return text;
}

struct Options {
  size_t rays = 1000000, runs = 7;
  std::string device, scene;
  bool peers = true;
};

void run(const Options& options, const std::string& command) {
  const Place place = load_place(options.scene);
  const std::vector<AccelTriangle> triangles = accel_triangles(place.scene);
  std::array<float, 3> origin;
  for (size_t axis = 0; axis < 3; axis++)
    origin[axis] = static_cast<float>(place.transmitter_m[axis] - place.scene.origin_m[static_cast<int>(axis)]);

  gpu::Context context(options.device);
  const gpu::DeviceInfo& info = context.info();
  std::vector<NamedTracer> tracers;  // ours, then peers
  std::vector<std::unique_ptr<DeviceScene>> device_scenes;
  for (const bool splits : {false, true}) {
    device_scenes.push_back(std::make_unique<DeviceScene>(make_device_scene(context, place.scene, splits)));
    const auto add = [&](const char* name, TraceShape shape) {
      tracers.push_back({std::string(name) + (splits ? "-splits" : ""),
                         std::make_unique<OurTracer>(context, *device_scenes.back(), shape, options.rays)});
    };
    if (info.cpu) {
      add("bvh8", TraceShape::bvh8);
      add("packet16", TraceShape::packet16);
    } else {
      add("bvh2", TraceShape::bvh2);
    }
  }
  const size_t ours = tracers.size();
  Tracer* truth = tracers.front().tracer.get();
#ifdef WAVETRACER_EMBREE
  for (const EmbreeConfig& config : embree_configs()) {
    if (!options.peers) break;
    tracers.push_back({config.name, std::make_unique<EmbreeTracer>(triangles, config)});
    if (config.robust && config.width == 1) truth = tracers.back().tracer.get();
  }
#else
  fmt::print(stderr,
             "bench_trace: built without Embree 3 (Debian: libembree-dev), so there is no peer to compare with\n");
#endif
  const std::string host_device = info.cpu ? info.name : "host CPU";

  for (const Directions directions : std::to_array<Directions>({"random", "hilbert"})) {
    const std::string label = fmt::format("{}, {} rays, {}", place.name, options.rays, directions.word());
    const auto [segments, expected] =
        make_segments(launch(context, directions, origin, options.rays), *truth, triangles);
    double ray_count = 0;
    for (const auto& segment : segments) ray_count += static_cast<double>(segment.size());
    const auto rate = [&](double seconds) { return ray_count / seconds * 1e-6; };

    const std::vector<Sample> samples = measure(tracers, segments, expected, options.runs);
    double best_single = 0;
    std::string best_name;
    std::array<double, kSegments> best_each;
    best_each.fill(std::numeric_limits<double>::infinity());
    const auto result = [&](size_t i) {
      return Result{"trace",
                    label + ": " + tracers[i].name,
                    i < ours ? info.name : host_device,
                    rate(sum(samples[i].seconds)),
                    "Mrays/s",
                    Better::higher,
                    "",
                    {},
                    static_cast<double>(samples[i].differing),
                    rates(segments, samples[i].seconds)};
    };
    for (size_t i = ours; i < tracers.size(); i++) {
      for (size_t s = 0; s < kSegments; s++) best_each[s] = std::min(best_each[s], samples[i].seconds[s]);
      if (rate(sum(samples[i].seconds)) > best_single) {
        best_single = rate(sum(samples[i].seconds));
        best_name = tracers[i].name;
      }
      print(result(i), command);
    }
    for (size_t i = 0; i < ours; i++) {
      Result one = result(i);
      if (ours < tracers.size()) {
        one.baseline = "Embree's best setting, " + best_name;
        one.baseline_value = best_single;
      }
      print(one, command);
      if (ours == tracers.size()) continue;
      one.name += ", against the best of each segment";
      one.baseline = "Embree's best setting for each segment";
      one.baseline_value = rate(sum(best_each));
      print(one, command);
    }
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Nearest hits of seven segments of specular bounces, beside Embree");
  bench::Options options;
  app.add_option("--rays", options.rays, "launched rays")->check(CLI::Range(1, 1 << 30));
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(5, 1000));
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--scene", options.scene,
                 "a scene file with (45, 90, 1.5) m in the open; default: munich, or a generated city");
  app.add_flag("!--no-peers", options.peers, "leave Embree out, on machines whose device is not the CPU");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_trace: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
