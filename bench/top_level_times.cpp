// SPDX-License-Identifier: Apache-2.0
// Cars are scattered over a square kilometre, at other places in each run; times are medians of wall time, without
// profiling. The scene below them is a generated block: placing does not depend on it.
#include "top_level_times.hpp"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

#include "accel/instance_tree.hpp"
#include "json_line.hpp"
#include "scene/load.hpp"
#include "scene/vehicle_model.hpp"
#include "simulation/placement.hpp"
#include "timing.hpp"

namespace wavetracer::bench {
namespace {

constexpr double half_width_m = 500;

std::vector<Placement> scattered(size_t count, std::mt19937& generator) {
  const auto draw = [&](double most) { return most * (static_cast<double>(generator()) * 0x1p-31 - 1); };
  std::vector<Placement> placements(count);
  for (Placement& p : placements) {
    p.position_m = {draw(half_width_m), draw(half_width_m), 0};
    p.rotation = glm::mat3_cast(glm::angleAxis(draw(std::numbers::pi), glm::dvec3(0, 0, 1)));
  }
  return placements;
}

// Returns boxes of cars without rotation: the time to build the tree does not depend on sizes.
std::vector<Box> boxes_of(const std::vector<Placement>& placements, const Scene& model) {
  std::vector<Box> boxes(placements.size());
  for (size_t i = 0; i < boxes.size(); i++)
    for (int axis = 0; axis < 3; axis++) {
      boxes[i].lower[axis] = static_cast<float>(placements[i].position_m[axis] + model.lower[axis]);
      boxes[i].upper[axis] = static_cast<float>(placements[i].position_m[axis] + model.upper[axis]);
    }
  return boxes;
}

// Returns the time of a frame's placement, including its transfers.
double place_seconds(gpu::Context& context, const Scene& block, const std::vector<Scene>& models,
                     const std::vector<Instance>& instances, TopLevelBuild build, size_t runs) {
  auto [scene, place] =
      with_instances(context, make_device_scene(context, block, false, 2 * half_width_m), block, models, instances);
  InstancePlacement placement(context, std::move(place), instances.size(), build);
  std::mt19937 generator(1);
  std::vector<double> seconds;
  for (size_t run = 0; run <= runs; run++) {
    const std::vector<Placement> placements = scattered(instances.size(), generator);
    context.finish();
    const double wall = wall_seconds([&] {
      placement.place(scene, placements);
      context.finish();
    });
    if (run > 0) seconds.push_back(wall);  // the first run also compiles
  }
  return median(seconds);
}

double host_tree_seconds(const Scene& model, size_t count, size_t runs) {
  std::mt19937 generator(1);
  std::vector<double> seconds;
  for (size_t run = 0; run < runs; run++) {
    const std::vector<Box> boxes = boxes_of(scattered(count, generator), model);
    TopLevel top;
    seconds.push_back(wall_seconds([&] { top = build_top_level(boxes); }));
  }
  return median(seconds);
}

}  // namespace

void print_top_level_times(const std::string& device, size_t runs, const std::string& command) {
  Config config;
  config.scene.generate = "--seed 1 --blocks 1x1";
  const Scene block = load_scene(config);
  const std::vector<Scene> models{vehicle_model("car", 5, 1.8, 1.5)};
  gpu::Context context(device);
  context.set_profiling(false);
  for (const uint32_t count : {100u, 200u, 400u, 1000u, 10000u}) {
    std::vector<Instance> instances(count);
    for (uint32_t i = 0; i < count; i++) {
      const auto first = block.surfaces.size() + i * models[0].surfaces.size();
      instances[i] = {fmt::format("car{}", i), "passenger", 0, static_cast<uint32_t>(first)};
    }
    const double tree_s = host_tree_seconds(models[0], count, runs);
    const double host_s = place_seconds(context, block, models, instances, TopLevelBuild::host, runs);
    const double device_s = place_seconds(context, block, models, instances, TopLevelBuild::device, runs);
    Result line;
    line.bench = "drive";
    line.device = context.info().name;
    line.unit = "s";
    line.better = Better::lower;
    line.extra = {{"instances", count}, {"host_s", host_s}, {"device_s", device_s}, {"host_tree_s", tree_s}};
    line.name = fmt::format("top level: {} instances, tree built on the device", count);
    line.value = device_s;
    line.baseline = "the same with the tree built on the host";
    line.baseline_value = host_s;
    line.detail =
        fmt::format("{:.4g} us; host {:.4g} us, of it {:.4g} us its tree", device_s * 1e6, host_s * 1e6, tree_s * 1e6);
    print(line, command);
  }
}

}  // namespace wavetracer::bench
