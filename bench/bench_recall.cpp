// SPDX-License-Identifier: Apache-2.0
// bench_recall measures the effect of more rays: seconds per frame against the share of known paths that are found, for
// each way of choosing directions. It needs the reference lists of specular paths; "error" is 1 - recall.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "frames.hpp"
#include "json_line.hpp"
#include "reference/compare.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

const char* const case_names[] = {"munich_street_0", "munich_street_1",    "munich_street_2",
                                  "munich_roof",     "munich_street_deep", "street_canyon_cars_specular",
                                  "box_depth5",      "triple_reflector",   "double_reflector",
                                  "simple_reflector"};

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> directions{"horizon", "hilbert", "fibonacci", "random"};
  size_t frames = 5;
  uint64_t most_rays = 10'000'000;
};

std::vector<RadioEnd> ends(const char* prefix, const std::vector<glm::dvec3>& points) {
  std::vector<RadioEnd> result;
  for (const glm::dvec3& p : points)
    result.push_back(
        {.name = fmt::format("{}{}", prefix, result.size()), .position_m = {p.x, p.y, p.z}, .polarization = "VH"});
  return result;
}

void run(const Options& options, const std::string& command) {
  const fs::path shared = options.shared;
  for (const char* name : case_names) {
    const fs::path list = shared / "oracle" / fmt::format("{}.json", name);
    if (!fs::exists(list)) {
      fmt::print(stderr, "bench_recall: {} is not there, so {} is skipped; --shared names its folder\n", list.string(),
                 name);
      continue;
    }
    const reference::Case reference = reference::load_case(list);
    Config config;
    config.scene.file = (shared / "scenes" / reference.scene / (reference.scene + ".xml")).string();
    config.radio.frequency_hz = reference.frequency_hz;
    config.trace.max_depth = reference.max_depth;
    config.transmitters = ends("tx", reference.transmitters_m);
    config.receivers = ends("rx", reference.receivers_m);
    for (const std::string& directions : options.directions) {
      config.trace.directions = Directions::named(directions);
      for (const uint64_t rays : {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
        if (rays > options.most_rays) break;
        config.trace.rays = rays;
        Simulation simulation(config, options.device);
        const Frames frames = run_frames(simulation, options.frames);
        const reference::Comparison comparison = reference::compare_paths(reference, frames.result.paths);
        Result result{"recall",
                      fmt::format("{}, {}, {:.0e} rays", name, directions, static_cast<double>(rays)),
                      simulation.device().name,
                      frames.median_s,
                      "s per frame",
                      Better::lower,
                      "",
                      {},
                      1 - comparison.recall,
                      fmt::format("{} of {} paths, {:.6f} of the power, {} more", comparison.found,
                                  comparison.reference, comparison.power_recall, comparison.extra)};
        result.extra = {{"rays", rays},
                        {"directions", directions},
                        {"paths", comparison.mine},
                        {"power_recall", comparison.power_recall},
                        {"sequences", frames.result.counts.sequences}};
        print(result, command);
      }
    }
  }
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Seconds a frame against the share of paths found");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds oracle/ and scenes/");
  app.add_option("--directions", options.directions, "some of horizon, hilbert, fibonacci, random")
      ->check(CLI::IsMember({"horizon", "hilbert", "fibonacci", "random"}));
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(1, 1000));
  app.add_option("--most-rays", options.most_rays, "leave out launches of more rays than this");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_recall: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
