// SPDX-License-Identifier: Apache-2.0
// bench_features measures the time that each kind of interaction adds to a frame of reflections, and checks that an
// interaction which a scene does not need adds nothing. "ratio" is the time of reflections over the frame's; "error" is
// the share that fewer rays or larger tiles miss.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "json_line.hpp"
#include "places.hpp"
#include "reference/compare.hpp"
#include "scene/load.hpp"
#include "turns.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_receivers = 24;
constexpr double scattering = 0.3;  // S of walls (V. Degli-Esposti et al., 2007: 0.2 to 0.5 for houses)
const char* const wall_materials[] = {"brick", "concrete", "marble"};

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  size_t repeat = 9;
  bool quick = false;
};

struct Group {  // variants of one configuration, compared with the first one
  std::string name;
  Config config;
  std::vector<Variant> variants;
};

void unchanged(Config&) {}

Variant transmission(uint32_t most) {
  return {fmt::format("transmission, {} a path", most), [most](Config& c) {
            c.trace.transmission = true;
            c.trace.max_transmissions = most;
          }};
}

Variant diffraction(bool free_edges, uint32_t most = 1) {
  return {fmt::format("{}, {}", most == 1 ? "diffraction" : "two diffractions", free_edges ? "free edges" : "wedges"),
          [=](Config& c) {
            c.trace.diffraction = true;
            c.trace.free_edges = free_edges;
            c.trace.max_diffractions = most;
          }};
}

Variant scattered(double tile_m) {
  return {fmt::format("scattering, tiles of {} m", tile_m), [tile_m](Config& c) {
            c.trace.scattering = true;
            c.trace.tile_m = tile_m;
          }};
}

Variant all_features() {
  return {"all", [](Config& c) {
            for (const Variant& one : {transmission(2), diffraction(true), scattered(10)}) one.change(c);
          }};
}

void roughen(Config& config) {
  for (const char* name : wall_materials) {
    MaterialConfig& material = config.materials.emplace_back();
    material.name = name;
    material.scattering = scattering;
  }
}

// Returns text such as "diffraction 812, transmission 3": paths with at least one of each.
std::map<std::string, size_t> paths_with(const Paths& paths) {
  std::map<std::string, size_t> counts;
  for (size_t i = 0; i < paths.size(); i++) {
    uint32_t bits = 0;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; k++) bits |= paths.vertex_interaction[k];
    for (const InteractionKind& kind : interaction_kinds)
      if (kind.code != reflection && (bits & kind.code)) counts[std::string(kind.word)]++;
  }
  return counts;
}

double scattered_power(const Paths& paths) {
  double sum = 0;
  for (size_t i = 0; i < paths.size(); i++)  // a scattered path is transmitter - tile - receiver
    if (paths.depth[i] == 1 && paths.vertex_interaction[paths.vertex_offset[i]] == scattering)
      sum += std::norm(paths.a[i][0]);
  return sum;
}

// Returns the longest stages of a frame, on the host and the device.
std::string longest_stages(const StageSeconds& seconds) {
  std::vector<std::pair<double, std::string>> stages;
  for (const auto& [name, s] : seconds)
    if (name != "frame") stages.emplace_back(s, name);
  std::sort(stages.rbegin(), stages.rend());
  stages.resize(std::min<size_t>(stages.size(), 4));
  std::string text;
  for (const auto& [s, name] : stages) text += fmt::format("{} {} {:.1f} ms", text.empty() ? "" : ",", name, 1e3 * s);
  return text;
}

Result result_of(const Group& group, size_t i, const Turns& first, const Turns& turn) {
  Result result{"features",
                fmt::format("{}: {}", group.name, group.variants[i].name),
                turn.device,
                turn.median_s,
                "s per frame",
                Better::lower,
                "",
                {},
                0,
                ""};
  if (i > 0) {
    result.baseline = group.variants[0].name;
    result.baseline_value = first.median_s;
    result.detail = fmt::format("cost {:.3f} +- {:.3f}; ", turn.cost, turn.cost_error);
  }
  const auto kinds = paths_with(turn.result.paths);
  result.detail += fmt::format("{} paths", turn.result.paths.size());
  for (const auto& [name, count] : kinds) result.detail += fmt::format(", {} {}", name, count);
  result.detail += ";" + longest_stages(turn.result.seconds);
  result.extra = {{"cost", turn.cost},
                  {"cost_error", turn.cost_error},
                  {"paths", turn.result.paths.size()},
                  {"paths_with", kinds},
                  {"segments", turn.result.counts.segments},
                  {"candidates", turn.result.counts.candidates},
                  {"seconds", turn.result.seconds}};
  return result;
}

// Prints the cost of each feature compared with reflections.
void print_costs(const Group& group, const Options& options, const std::string& command) {
  const std::vector<Turns> turns = run_in_turn(group.config, group.variants, options.device, options.repeat);
  for (size_t i = 0; i < turns.size(); i++) print(result_of(group, i, turns[0], turns[i]), command);
}

// Prints for rays of listeners: the diffracted paths, and their power, that the largest number finds and smaller ones
// miss.
void print_listeners(Group group, const std::vector<uint64_t>& rays, const Options& options,
                     const std::string& command) {
  for (const uint64_t count : rays)
    group.variants.push_back(
        {fmt::format("diffraction, {:.0e} rays per receiver", static_cast<double>(count)), [count](Config& c) {
           diffraction(true).change(c);
           c.trace.diffraction_rays = count;
         }});
  const std::vector<Turns> turns = run_in_turn(group.config, group.variants, options.device, options.repeat);
  reference::Case most;
  most.name = group.name;
  most.paths = turns.back().result.paths;
  for (size_t i = 1; i < turns.size(); i++) {
    Result result = result_of(group, i, turns[0], turns[i]);
    const reference::Comparison all = reference::compare_paths(most, turns[i].result.paths);
    const auto found = all.kinds.find("diffraction");
    if (found != all.kinds.end()) {
      const reference::Agreement& diffracted = found->second;
      result.error = 1 - diffracted.recall;
      result.detail = fmt::format("{} of {} diffracted paths, {:.6f} of their power; {}", diffracted.found,
                                  diffracted.reference, diffracted.power_recall, result.detail);
      result.extra["power_recall"] = diffracted.power_recall;
    }
    print(result, command);
  }
}

// Prints for tiles: the scattered power compared with that of the finest ones.
void print_tiles(Group group, const std::vector<double>& tiles_m, const Options& options, const std::string& command) {
  for (const double tile_m : tiles_m) group.variants.push_back(scattered(tile_m));
  const std::vector<Turns> turns = run_in_turn(group.config, group.variants, options.device, options.repeat);
  const double finest = scattered_power(turns.back().result.paths);
  for (size_t i = 1; i < turns.size(); i++) {
    Result result = result_of(group, i, turns[0], turns[i]);
    const double power = scattered_power(turns[i].result.paths);
    if (finest > 0) result.error = std::abs(power / finest - 1);
    result.extra["scattered_power"] = power;
    print(result, command);
  }
}

bool same_stages(const StageSeconds& a, const StageSeconds& b) {
  return std::ranges::equal(
      a, b, {}, [](const auto& stage) { return stage.first; }, [](const auto& stage) { return stage.first; });
}

// A feature that was asked for, but is absent from the scene: the second variant must equal the first one. "error" is 1
// if it does not.
void print_absent(const Group& group, const std::string& feature, const Options& options, const std::string& command) {
  const std::vector<Turns> turns = run_in_turn(group.config, group.variants, options.device, options.repeat);
  const Feature& state = turns[1].features.at(feature);
  if (state.on) throw RuntimeError(fmt::format("{}: the scene has {}, so this measures nothing", group.name, feature));
  Result result = result_of(group, 1, turns[0], turns[1]);
  const Paths &before = turns[0].result.paths, &after = turns[1].result.paths;
  const bool same_paths = before.a == after.a && before.delay_s == after.delay_s;
  const bool same_launches = same_stages(turns[0].result.seconds, turns[1].result.seconds);
  result.error = same_paths && same_launches ? 0 : 1;
  result.detail = fmt::format("{}; {} stages, {} paths; {}", state.reason, same_launches ? "the same" : "other",
                              same_paths ? "the same" : "other", result.detail);
  result.extra["same_stages"] = same_launches;
  result.extra["same_paths"] = same_paths;
  print(result, command);
}

Group group_of(const Place& place, uint32_t depth, size_t receivers) {
  Group group{fmt::format("{}, 1x{}, depth {}", place.name, receivers, depth), config_of(place, 1, receivers), {}};
  group.config.trace.max_depth = depth;
  group.variants.push_back({"reflections", unchanged});
  return group;
}

// Returns one transmitter and one receiver in a scene of shared/scenes; nothing if the scene is missing.
std::optional<Place> small_place(const std::string& shared, const std::string& name,
                                 std::array<double, 3> transmitter_m, std::array<double, 3> receiver_m) {
  const fs::path file = fs::path(shared) / "scenes" / name / (name + ".xml");
  if (!fs::exists(file)) return {};
  Place place;
  place.name = name;
  place.scene.file = file.string();
  place.transmitters = {{.name = "tx", .position_m = transmitter_m}};
  place.receivers = {{.name = "rx", .position_m = receiver_m}};
  return place;
}

void run_costs(const Place& place, const Options& options, const std::string& command) {
  for (const uint32_t depth : options.quick ? std::vector<uint32_t>{3} : std::vector<uint32_t>{5, 3})
    for (const size_t receivers : options.quick ? std::vector<size_t>{1} : std::vector<size_t>{1, most_receivers}) {
      Group group = group_of(place, depth, receivers);
      roughen(group.config);
      for (const Variant& variant :
           {transmission(1), transmission(2), diffraction(false), diffraction(true), scattered(10), all_features()})
        group.variants.push_back(variant);
      print_costs(group, options, command);
    }
}

void run_absent(const Place& place, const std::optional<Place>& plates, const Options& options,
                const std::string& command) {
  Group group = group_of(place, 5, options.quick ? 1 : most_receivers);
  group.variants.push_back({"scattering, no rough material", [](Config& c) { c.trace.scattering = true; }});
  print_absent(group, "scattering", options, command);

  for (const Material& known : load_scene(group.config).materials) {
    MaterialConfig& material = group.config.materials.emplace_back();
    material.name = known.name;
    material.thickness_m = std::numeric_limits<double>::infinity();
  }
  group.variants[1] = {"transmission, half spaces alone", [](Config& c) { c.trace.transmission = true; }};
  print_absent(group, "transmission", options, command);

  if (!plates) return;
  group = group_of(*plates, 5, 1);
  group.config.trace.free_edges = false;
  group.variants.push_back({"diffraction, no wedge", [](Config& c) { c.trace.diffraction = true; }});
  print_absent(group, "diffraction", options, command);
}

void run(Options options, const std::string& command) {
  if (options.quick) options.repeat = std::min<size_t>(options.repeat, 5);
  const Place city = city_place(1, most_receivers);
  const std::optional<Place> munich = munich_place(options.shared, 1, most_receivers);
  const auto canyon = small_place(options.shared, "simple_street_canyon", {33.5, 5.5, 1.5}, {-49, -2, 1.5});
  const auto plates = small_place(options.shared, "triple_reflector", {0.3, 0.2, 1}, {0.5, 0.4, 1.5});
  if (!munich || !canyon || !plates)
    fmt::print(stderr,
               "bench_features: munich, simple_street_canyon or triple_reflector is not in {}/scenes, "
               "so cases are left out; --shared names their folder\n",
               options.shared);
  const Place& main = munich ? *munich : city;

  run_costs(main, options, command);
  if (munich && !options.quick) run_costs(city, options, command);
  run_absent(main, plates, options, command);
  for (const size_t receivers : options.quick ? std::vector<size_t>{1} : std::vector<size_t>{1, most_receivers})
    print_listeners(group_of(main, 5, receivers), {10'000, 100'000, 1'000'000}, options, command);
  Group tiled = group_of(main, 5, 1);
  roughen(tiled.config);
  print_tiles(tiled, {10, 5, 2.5}, options, command);
  if (canyon) {
    tiled = group_of(*canyon, 5, 1);
    roughen(tiled.config);
    print_tiles(tiled, {10, 5, 2.5, 1.25}, options, command);
    Group twice = group_of(*canyon, 3, 1);
    twice.variants.insert(twice.variants.end(), {diffraction(true), diffraction(true, 2)});
    print_costs(twice, options, command);
  }
  Group around = group_of(city_place(1, 24), 3, 24);
  around.variants.insert(around.variants.end(), {diffraction(true), diffraction(true, 2)});
  print_costs(around, options, command);
  Group twice = group_of(main, 2, 1);
  twice.variants.insert(twice.variants.end(), {diffraction(false), diffraction(false, 2)});
  print_costs(twice, options, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Measures the time that each kind of interaction adds to a frame, and checks that absent ones add none");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich and others");
  app.add_option("--repeat", options.repeat, "warm frames of which the median counts")->check(CLI::Range(3, 1000));
  app.add_flag("--quick", options.quick, "one scene, depth 3 and one link alone, at most 5 warm frames");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_features: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
