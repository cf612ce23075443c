// SPDX-License-Identifier: Apache-2.0
// Moving worlds for the tests of place and top_level: instances of models of loose triangles, and rays among them.
// Assumes coordinates of at most 60 m.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <string>
#include <vector>

#include "passes/triangles.hpp"
#include "simulation/placement.hpp"

namespace wavetracer::test {

// Two models of loose triangles, many instances of them, and the resulting world.
struct Traffic {
  std::vector<Corners> still;
  std::vector<std::vector<Corners>> bodies;
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<Placement> placements;

  // Instances stand within half_m of the origin along each axis.
  Traffic(size_t count, uint32_t seed, double half_m = 9) : still(random_soup(60, 12, 2, seed)) {
    Random random(seed + 1);
    bodies = {random_soup(12, 1, 1.5, seed + 2), random_soup(30, 1.5, 1.5, seed + 3)};
    for (const auto& body : bodies) models.push_back(scene_of_triangles(body));
    auto first = static_cast<uint32_t>(still.size());
    for (size_t i = 0; i < count; ++i) {
      const uint32_t model = random.below(2);
      instances.push_back({"v" + std::to_string(i), "car", model, first});
      first += static_cast<uint32_t>(bodies[model].size());
      Placement placement;
      placement.position_m = random.in_cube(half_m);
      placement.rotation = glm::mat3_cast(glm::angleAxis(random.between(0, 6.28), random.direction()));
      placements.push_back(placement);
    }
  }

  // Surface and triangle numbers are those of the instances.
  Scene baked() const {
    std::vector<Corners> all = still;
    for (size_t i = 0; i < instances.size(); ++i)
      for (const Corners& corners : bodies[instances[i].model]) {
        Corners moved;
        for (size_t k = 0; k < 3; ++k) moved[k] = placements[i].position_m + placements[i].rotation * corners[k];
        all.push_back(moved);
      }
    return scene_of_triangles(all);
  }

  std::multiset<uint32_t> present() const {
    std::multiset<uint32_t> numbers;
    for (uint32_t i = 0; i < placements.size(); ++i)
      if (placements[i].present) numbers.insert(i);
    return numbers;
  }

  DeviceScene upload(TopLevelBuild build = TopLevelBuild::host) const {
    const Scene base = scene_of_triangles(still);
    PlacedScene placed =
        with_instances(context(), make_device_scene(context(), base, false, 60), base, models, instances);
    InstancePlacement(context(), std::move(placed.place), instances.size(), build).place(placed.scene, placements);
    return std::move(placed.scene);
  }
};

inline std::vector<Ray> rays_in(double half, size_t count, uint32_t surface_count, uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    const glm::dvec3 o = random.in_cube(half), d = random.direction();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[static_cast<size_t>(axis)] = static_cast<float>(o[axis]);
      ray.direction[static_cast<size_t>(axis)] = static_cast<float>(d[axis]);
    }
    if (random() < 0.5) ray.surface = random.below(surface_count);
  }
  return rays;
}

// Every seventh is absent if there are three or more, so that worlds of one, two and three exist too.
inline Traffic with_gaps(size_t count, double half_m) {
  Traffic traffic(count, static_cast<uint32_t>(count), half_m);
  for (size_t i = 3; i < count; i += 7) traffic.placements[i].present = false;
  return traffic;
}

// Compares the tree of the device with that of the host: hits are the same bit for bit, including distances.
inline void check_hits(const Traffic& traffic, size_t rays_count, double half_m) {
  const DeviceScene host = traffic.upload(TopLevelBuild::host), device = traffic.upload(TopLevelBuild::device);
  const size_t still = traffic.still.size();
  const std::vector<Ray> rays = rays_in(half_m, rays_count, static_cast<uint32_t>(still), 13);
  for (const TraceShape shape : shapes()) {
    CAPTURE(name_of(shape));
    const std::vector<Hit> hits = trace(host, shape, rays);
    CHECK(trace(device, shape, rays) == hits);
    const auto moving = std::ranges::count_if(hits, [&](const Hit& h) { return !h.missed() && h.surface >= still; });
    CHECK((moving > 0) == !traffic.present().empty());  // otherwise the test would prove nothing
  }
}

}  // namespace wavetracer::test
