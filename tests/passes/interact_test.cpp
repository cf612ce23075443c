// SPDX-License-Identifier: Apache-2.0
// interact: which rays continue, their order, nodes, origins and directions.
// Reflections are compared with the mirror law in double.
#include "passes/interact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "passes/exact.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// One step of the wavefront loop on the device.
struct Step {
  std::vector<Hit> hits;
  std::vector<Ray> next, behind;
  std::vector<uint64_t> table;
  std::vector<uint32_t> quarters;

  Step(const Scene& scene, const std::vector<Ray>& rays, bool last = false, bool through = false) {
    const DeviceScene uploaded = make_device_scene(context(), scene, false);
    const RayQueue queue = upload(rays);
    RayQueue after = make_ray_queue(context(), rays.size(), "next rays");
    RayQueue transmitted = make_ray_queue(context(), rays.size(), "transmitted rays");
    HitList list = make_hit_list(context(), rays.size());
    Sequences set(context(), 4096);
    Trace trace_pass(context(), uploaded, shapes().back());
    Scan scan(context());
    Interact interact(context(), {.transmission = through});
    trace_pass(uploaded, queue, list);
    hits = download(list, rays.size());
    const uint32_t alive = scan(list.block_hits, list.blocks(queue.count));
    interact(uploaded, queue, list, alive, set.trie(),
             {.reflected = last ? nullptr : &after, .transmitted = through ? &transmitted : nullptr});
    next = download(after);
    behind = download(transmitted);
    table = set.table().read();
    quarters = set.quarters().read();
    // A ray without a prefix is marked.
    CHECK(set.overflowed() == std::ranges::any_of(rays, [](const Ray& ray) { return ray.node == WT_NONE; }));
  }
};

double height(const Surface& surface, const glm::dvec3& p) { return glm::dot(surface.normal, p) - surface.offset_m; }

}  // namespace

TEST_CASE("rays that hit go on in their order, mirrored, on the side they came from, with their node") {
  // Half of the triangles of a ball: about half of the rays fly out.
  std::vector<Corners> triangles = room(Room::ball, 4, 10, {3, -2, 1});
  for (size_t i = 0; i < triangles.size(); i += 2) triangles[i / 2] = triangles[i];
  triangles.resize(triangles.size() / 2);
  const Scene scene = scene_of_triangles(triangles);
  for (const uint32_t count : {1u, 15u, 16u, 17u, 700u}) {
    CAPTURE(count);
    Random random(count);
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
      rays.push_back(ray_towards(glm::dvec3{3, -2, 1} + random.in_cube(3), random.direction()));
      rays.back().node = WT_ROOT | (i % 5);
    }
    const Step step(scene, rays);
    size_t j = 0, wrong = 0;
    for (uint32_t i = 0; i < count; ++i) {
      if (step.hits[i].missed()) continue;
      REQUIRE(j < step.next.size());
      const Ray& after = step.next[j++];
      const Surface& surface = scene.surfaces[step.hits[i].surface];
      wrong += after.surface != step.hits[i].surface;
      // The node is the pair of the ray's former node and the surface that it hit.
      wrong +=
          after.node >= step.table.size() || step.table[after.node] != ((uint64_t{rays[i].node} << 32) | after.surface);
      const glm::dvec3 d = to_double(rays[i].direction), o = to_double(rays[i].origin);
      const glm::dvec3 mirrored = d - 2 * glm::dot(d, surface.normal) * surface.normal;
      wrong += glm::distance(to_double(after.direction), mirrored) > 1e-6;
      const double before_side = height(surface, o), after_side = height(surface, to_double(after.origin));
      wrong += before_side * after_side <= 0;
      wrong += std::abs(after_side) > 1e-4;
      wrong += glm::distance(to_double(after.origin), o + double{step.hits[i].t} * d) > 1e-4;
    }
    CHECK(j == step.next.size());
    CHECK(wrong == 0);
    if (count == 700) CHECK(j > 200);
    if (count == 700) CHECK(j < 500);
  }
}

TEST_CASE("at the last depth the nodes are entered and the next queue is left alone") {
  const Scene scene = scene_of_triangles(room(Room::box, 1, 5));
  const Step step(scene, {ray_towards({0, 0, 0}, {1, 0.1, 0.2}), ray_towards({0, 0, 0}, {-1, 0.1, 0.2})}, true);
  CHECK(step.next.empty());
  CHECK(std::count(step.table.begin(), step.table.end(), WT_EMPTY) == 4096 - 2);
}

TEST_CASE("rays that share a prefix share its node, and no other ray does") {
  const Scene scene = scene_of_triangles({{{{4, -50, -50}, {4, 100, -50}, {4, -50, 100}}}});
  std::vector<Ray> rays;
  for (int i = 0; i < 40; ++i) {
    rays.push_back(ray_towards({0, 0, 0}, {1, 0.01 * i, 0}));
    rays.back().node = WT_ROOT | static_cast<uint32_t>(i / 20);
  }
  const Step step(scene, rays);
  REQUIRE(step.next.size() == 40);
  for (size_t i = 0; i < 40; ++i) CHECK(step.next[i].node == step.next[i / 20 * 20].node);
  CHECK(step.next[0].node != step.next[20].node);
}

TEST_CASE("a mirrored ray starts off the surface also far from the origin and at grazing incidence") {
  for (const double far : {0.0, 10.0, 1000.0, 5000.0})
    for (const double slope : {1.0, 1e-2, 1e-4}) {
      CAPTURE(far);
      CAPTURE(slope);
      const glm::dvec3 at{far, -far, far / 3};
      const glm::dvec3 normal = glm::normalize(glm::dvec3{1, 2, -2}), along = glm::normalize(glm::dvec3{2, -1, 0});
      const glm::dvec3 across = glm::cross(normal, along);
      const Scene scene = scene_of_triangles(
          {{{at - 40.0 * along - 30.0 * across, at + 40.0 * along - 30.0 * across, at + 60.0 * across}}});
      for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 from = at + side * 10 * slope * normal - 10.0 * along;
        const Step step(scene, {ray_towards(from, at - from)});
        REQUIRE(step.next.size() == 1);
        const double above = height(scene.surfaces[0], to_double(step.next[0].origin));
        CHECK(above * side > 0);
        CHECK(std::abs(above) < 1e-5 * std::max(1.0, far));
      }
    }
}

TEST_CASE("with transmission rays that hit also go on straight behind the surface, in the same places") {
  std::vector<Corners> triangles = room(Room::ball, 4, 10, {3, -2, 1});
  for (size_t i = 0; i < triangles.size(); i += 2) triangles[i / 2] = triangles[i];
  triangles.resize(triangles.size() / 2);
  const Scene scene = scene_of_triangles(triangles);
  for (const uint32_t count : {1u, 17u, 700u}) {
    CAPTURE(count);
    Random random(count + 100);
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
      rays.push_back(ray_towards(glm::dvec3{3, -2, 1} + random.in_cube(3), random.direction()));
      rays.back().node = WT_ROOT | (i % 5);
    }
    const Step without(scene, rays), step(scene, rays, false, true), last(scene, rays, true, true);
    // Reflected rays are the same to the last bit; a node is its slot, and which ray comes to a slot first may differ.
    const auto without_nodes = [](std::vector<Ray> of) {
      for (Ray& ray : of) ray.node = 0;
      return of;
    };
    CHECK(without_nodes(step.next) == without_nodes(without.next));
    CHECK(last.next.empty());
    CHECK(last.behind == step.behind);
    REQUIRE(step.behind.size() == step.next.size());
    size_t j = 0, wrong = 0;
    for (uint32_t i = 0; i < count; ++i) {
      if (step.hits[i].missed()) continue;
      const Ray& after = step.behind[j++];
      const Surface& surface = scene.surfaces[step.hits[i].surface];
      wrong +=
          after.surface != step.hits[i].surface || after.node != rays[i].node || after.direction != rays[i].direction;
      const glm::dvec3 d = to_double(rays[i].direction), o = to_double(rays[i].origin);
      const double before_side = height(surface, o), after_side = height(surface, to_double(after.origin));
      wrong += before_side * after_side >= 0;
      wrong += std::abs(after_side) > 1e-4;
      wrong += glm::distance(to_double(after.origin), o + double{step.hits[i].t} * d) > 1e-4;
    }
    CHECK(wrong == 0);
    if (count == 700) CHECK(j > 200);
  }
}

TEST_CASE("a transmitted ray starts behind the surface also far from the origin and at grazing incidence") {
  for (const double far : {0.0, 1000.0, 5000.0})
    for (const double slope : {1.0, 1e-2, 1e-4}) {
      CAPTURE(far);
      CAPTURE(slope);
      const glm::dvec3 at{far, -far, far / 3};
      const glm::dvec3 normal = glm::normalize(glm::dvec3{1, 2, -2}), along = glm::normalize(glm::dvec3{2, -1, 0});
      const glm::dvec3 across = glm::cross(normal, along);
      const Scene scene = scene_of_triangles(
          {{{at - 40.0 * along - 30.0 * across, at + 40.0 * along - 30.0 * across, at + 60.0 * across}}});
      for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 from = at + side * 10 * slope * normal - 10.0 * along;
        const Step step(scene, {ray_towards(from, at - from)}, false, true);
        REQUIRE(step.behind.size() == 1);
        const double above = height(scene.surfaces[0], to_double(step.behind[0].origin));
        CHECK(above * side < 0);
        CHECK(std::abs(above) < 1e-5 * std::max(1.0, far));
      }
    }
}

TEST_CASE(
    "a node has the quarters of the rays that reached it, and rays keep theirs; a ray without a prefix enters none") {
  const Scene scene = scene_of_triangles(room(Room::ball, 4, 10, {3, -2, 1}));
  Random random(7);
  std::vector<Ray> rays;
  for (uint32_t i = 0; i < 900; ++i) {
    // Neighbours share a surface, as in a launch, and often a transmitter; few of a quarter are left for some.
    const glm::dvec3 around = i % 30 < 20 ? glm::dvec3{1, 0.02 * random(), 0.02 * random()} : random.direction();
    rays.push_back(ray_towards({3, -2, 1}, around));
    const uint32_t quarter = random() < 0.1 ? random.below(4) : (i / 100) % 4;
    rays.back().node = i % 50 == 49 ? WT_NONE : WT_ROOT | (i / 90) | quarter << WT_QUARTER_SHIFT;
  }
  const Step step(scene, rays, false, true);
  std::map<uint64_t, uint32_t> expected;
  size_t j = 0, wrong = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (step.hits[i].missed()) continue;
    const Ray &after = step.next[j], &behind = step.behind[j];
    ++j;
    if (rays[i].node == WT_NONE) {
      wrong += after.node != WT_NONE || behind.node != WT_NONE;
      continue;
    }
    const uint64_t parent = rays[i].node & ~WT_QUARTER_BITS;
    expected[parent << 32 | step.hits[i].surface] |= 1u << (rays[i].node >> WT_QUARTER_SHIFT & 3);
    wrong += (after.node & WT_QUARTER_BITS) != (rays[i].node & WT_QUARTER_BITS) || behind.node != rays[i].node;
    wrong += step.table[after.node & ~WT_QUARTER_BITS] != (parent << 32 | step.hits[i].surface);
  }
  CHECK(j > 800);
  CHECK(wrong == 0);
  std::map<uint64_t, uint32_t> found;
  std::set<uint32_t> kinds;
  for (size_t slot = 0; slot < step.table.size(); ++slot)
    if (step.table[slot] != WT_EMPTY) kinds.insert(found[step.table[slot]] = step.quarters[slot]);
  CHECK(found == expected);
  CHECK(kinds.size() > 5);  // 15 kinds exist
}

TEST_CASE("what its options need and nobody gives is refused") {
  const DeviceScene scene =
      make_device_scene(context(), scene_of_triangles(room(Room::ball, 4, 10, {3, -2, 1})), false);
  RayQueue rays = make_ray_queue(context(), 16, "rays"), behind = make_ray_queue(context(), 16, "transmitted rays");
  const HitList hits = make_hit_list(context(), 16);
  Sequences set(context(), 4096);  // does not keep ages
  CHECK_THROWS_AS(Interact(context(), {.ages = true})(scene, rays, hits, 0, set.trie(), {}), std::logic_error);
  CHECK_THROWS_AS(Interact(context(), {.samples = true})(scene, rays, hits, 0, set.trie(), {}), std::logic_error);
  CHECK_THROWS_AS(Interact(context(), {})(scene, rays, hits, 0, set.trie(), {.transmitted = &behind}),
                  std::logic_error);
}
