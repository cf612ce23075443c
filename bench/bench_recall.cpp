// SPDX-License-Identifier: Apache-2.0
// bench_recall measures the effect of more rays: seconds per frame against the share of known paths that are found, for
// each way of choosing directions, and for beams. It needs the reference lists of specular paths; "error" is 1 -
// recall. Rows of rays also say how many paths of the list by beams they find, and how many that list lacks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "frames.hpp"
#include "json_line.hpp"
#include "path_recall.hpp"
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
  std::vector<std::string> cases{std::begin(case_names), std::end(case_names)};
  std::vector<std::string> directions{"horizon", "hilbert", "fibonacci", "random"};
  bool beams = true;
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

// One of the reference lists, with the configuration that computes its paths.
struct Task {
  std::string name;
  reference::Case reference;
  Config config;
};

Task task_of(const std::string& name, const fs::path& shared, const fs::path& list) {
  Task out{name, reference::load_case(list), {}};
  Config& config = out.config;
  config.scene.file = (shared / "scenes" / out.reference.scene / (out.reference.scene + ".xml")).string();
  config.radio.frequency_hz = out.reference.frequency_hz;
  config.trace.max_depth = out.reference.max_depth;
  config.transmitters = ends("tx", out.reference.transmitters_m);
  config.receivers = ends("rx", out.reference.receivers_m);
  return out;
}

// The row of a setting, judged by the reference list.
Result row_of(const Task& task, const std::string& setting, const std::string& device, const Frames& frames) {
  const reference::Comparison compared = reference::compare_paths(task.reference, frames.result.paths);
  Result result{"recall",
                fmt::format("{}, {}", task.name, setting),
                device,
                frames.median_s,
                "s per frame",
                Better::lower,
                "",
                {},
                1 - compared.recall,
                fmt::format("{} of {} paths, {:.6f} of the power, {} more", compared.found, compared.reference,
                            compared.power_recall, compared.extra)};
  result.extra = {
      {"paths", compared.mine}, {"power_recall", compared.power_recall}, {"sequences", frames.result.counts.sequences}};
  return result;
}

// Returns the list by beams.
Paths measure_beams(const Options& options, const Task& task, const std::string& command) {
  Config config = task.config;
  config.trace.discovery = "beams";
  Simulation simulation(config, options.device);
  Frames frames = run_frames(simulation, options.frames);
  Result row = row_of(task, "beams", simulation.device().name, frames);
  const Certificate& of = frames.result.certificate;
  row.detail += fmt::format("; {:.1e} sr of beams were not followed", of.left_out_sr);
  row.extra.update({{"depth", of.depth}, {"left_out_sr", of.left_out_sr}});
  print(row, command);
  return std::move(frames.result.paths);
}

// Returns the number of paths that the list by beams lacks.
size_t measure_rays(const Options& options, Task& task, const std::optional<Paths>& by_beams,
                    const std::string& command) {
  size_t only_rays = 0;
  for (const std::string& directions : options.directions) {
    task.config.trace.directions = Directions::named(directions);
    for (const uint64_t rays : {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
      if (rays > options.most_rays) break;
      task.config.trace.rays = rays;
      Simulation simulation(task.config, options.device);
      const Frames frames = run_frames(simulation, options.frames);
      const std::string setting = fmt::format("{}, {:.0e} rays", directions, static_cast<double>(rays));
      Result row = row_of(task, setting, simulation.device().name, frames);
      row.extra.update({{"rays", rays}, {"directions", directions}});
      if (by_beams) {
        const PathRecall recall = path_recall(*by_beams, frames.result.paths);
        row.detail += fmt::format("; {} of the {} by beams", recall.found, recall.reference);
        row.extra.update({{"beams", recall.reference}, {"of_beams", recall.found}, {"only_rays", recall.extra()}});
        only_rays += recall.extra();
      }
      print(row, command);
    }
  }
  return only_rays;
}

// Returns the number of paths that rays have found and beams have not.
size_t run(const Options& options, const std::string& command) {
  const fs::path shared = options.shared;
  size_t only_rays = 0;
  for (const std::string& name : options.cases) {
    const fs::path list = shared / "oracle" / fmt::format("{}.json", name);
    if (!fs::exists(list)) {
      fmt::print(stderr, "bench_recall: {} is not there, so {} is skipped; --shared names its folder\n", list.string(),
                 name);
      continue;
    }
    Task task = task_of(name, shared, list);
    std::optional<Paths> by_beams;
    if (options.beams) by_beams = measure_beams(options, task, command);
    only_rays += measure_rays(options, task, by_beams, command);
  }
  return only_rays;
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Seconds a frame against the share of paths found");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds oracle/ and scenes/");
  app.add_option("--cases", options.cases, "some of the lists")
      ->check(CLI::IsMember(std::vector<std::string>{std::begin(bench::case_names), std::end(bench::case_names)}));
  app.add_flag("--beams,!--no-beams", options.beams, "measure beams as well, and compare rays with their list");
  app.add_option("--directions", options.directions, "some of horizon, hilbert, fibonacci, random")
      ->check(CLI::IsMember({"horizon", "hilbert", "fibonacci", "random"}));
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(1, 1000));
  app.add_option("--most-rays", options.most_rays, "leave out launches of more rays than this");
  CLI11_PARSE(app, argc, argv);
  try {
    if (const size_t only_rays = bench::run(options, bench::command_line(argc, argv)); only_rays > 0) {
      fmt::print(stderr, "bench_recall: beams lack {} paths that rays have found\n", only_rays);
      return 1;
    }
  } catch (const Error& error) {
    fmt::print(stderr, "bench_recall: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
