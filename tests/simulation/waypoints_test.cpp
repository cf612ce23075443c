// SPDX-License-Identifier: Apache-2.0
// Tests output.waypoints: the sampled rays, their points, and the receivers that they pass, for every order of tracing.
// The scenes are a box, where every ray continues to the last depth, and a ground, which half of the rays miss.
#include <algorithm>
#include <array>

#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const glm::dvec3 size{8, 5, 3}, corner{1000, -2000, 30};

Config box_config(const SceneFile& file, uint64_t rays, uint64_t samples) {
  Config config = config_of(file.path(), {corner + glm::dvec3{1.4, 2.2, 1.6}, corner + glm::dvec3{6, 1, 2}},
                            {corner + size / 2.0}, rays, 3);
  config.output.waypoints = samples;
  return config;
}

SceneFile box() { return SceneFile(reference::box_walls(corner, corner + size)); }

bool equal(const WaypointRows& a, const WaypointRows& b) {
  if (!(a.frame == b.frame && a.tx == b.tx && a.sample == b.sample && a.depth == b.depth && a.kind == b.kind &&
        a.surface == b.surface && a.instance == b.instance))
    return false;
  return a.position_m == b.position_m;
}

}  // namespace

TEST_CASE("samples are spread evenly, and their rays are mirrored from wall to wall") {
  const SceneFile file = box();
  const WaypointRows rows = run(box_config(file, 1000, 10)).waypoints;
  REQUIRE(rows.size() == size_t{2} * 10 * 4);  // launch and three reflections
  size_t wrong = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const uint64_t number = i / 4 % 10;
    CHECK(rows.tx[i] == i / 40);
    CHECK(rows.sample[i] == number * 100 + 50);  // the middle of each tenth
    CHECK(rows.depth[i] == i % 4);
    CHECK(rows.kind[i] == (i % 4 == 0 ? WaypointKind::launch : WaypointKind::reflection));
    const glm::dvec3 p = rows.position_m[i] - corner;
    if (i % 4 == 0) {
      CHECK(glm::distance(p, i < 40 ? glm::dvec3{1.4, 2.2, 1.6} : glm::dvec3{6, 1, 2}) < 1e-5);
      CHECK(rows.surface[i] == no_surface);
      continue;
    }
    CHECK(rows.surface[i] < 6);
    int walls = 0;
    for (int axis = 0; axis < 3; ++axis) walls += std::min(std::abs(p[axis]), std::abs(p[axis] - size[axis])) < 1e-9;
    wrong += walls != 1;
    if (i % 4 == 3) continue;
    // The mirror law at every reflection that has a segment before and after: one component turns.
    const glm::dvec3 in = rows.position_m[i] - rows.position_m[i - 1];
    const glm::dvec3 out = rows.position_m[i + 1] - rows.position_m[i];
    const double apart = glm::distance(glm::abs(glm::normalize(in)), glm::abs(glm::normalize(out)));
    wrong += apart > 1e-5 / std::min(glm::length(in), glm::length(out));  // the points are right to some 1e-6
    int turned = 0;
    for (int axis = 0; axis < 3; ++axis) turned += in[axis] * out[axis] < 0;
    wrong += turned != 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("the same rows in any order, in small batches, and all of them where more are asked than there are") {
  const SceneFile file = box();
  Config config = box_config(file, 1000, 37);
  const WaypointRows plain = run(config).waypoints;
  CHECK(plain.size() == size_t{2} * 37 * 4);
  config.trace.batch_rays = 300;
  CHECK(equal(run(config).waypoints, plain));
  config.order.method = "morton";
  config.order.each_depth = true;
  CHECK(equal(run(config).waypoints, plain));
  config.output.waypoints = 5000;
  const WaypointRows all = run(config).waypoints;
  REQUIRE(all.size() == size_t{2} * 1000 * 4);
  for (size_t i = 0; i < all.size(); i += 4) CHECK(all.sample[i] == i / 4 % 1000);
}

TEST_CASE("over a ground, rays that go up miss, and those that go down hit it once") {
  const SceneFile file({{{-1e4, -1e4, 0}, {2e4, 0, 0}, {0, 2e4, 0}}});
  Config config = config_of(file.path(), {{0, 0, 10}}, {{5, 0, 1}}, 500, 4);
  config.trace.directions = "hilbert";
  config.output.waypoints = 500;
  const WaypointRows rows = run(config).waypoints;
  size_t up = 0, down = 0, wrong = 0;
  for (size_t i = 0; i < rows.size();) {
    REQUIRE(rows.kind[i] == WaypointKind::launch);
    const bool hits = i + 1 < rows.size() && rows.kind[i + 1] == WaypointKind::reflection;
    const size_t last = i + (hits ? 2 : 1);
    REQUIRE(last < rows.size());
    CHECK(rows.kind[last] == WaypointKind::miss);
    const glm::dvec3 way = rows.position_m[last] - rows.position_m[last - 1];
    wrong += std::abs(glm::length(way) - 1) > 1e-5 || way.z <= 0;
    (hits ? down : up) += 1;
    i = last + 1;
  }
  CHECK(wrong == 0);
  CHECK(up + down == 500);
  CHECK(std::max(up, down) - std::min(up, down) < 10);  // directions are even; nearly level ones miss the ground
}

TEST_CASE("with spheres, rows tell of every reception") {
  const SceneFile file = box();
  Config config = box_config(file, 1000, 1000);
  config.trace.reception = "sphere";
  config.trace.sphere_radius_m = 0.5;
  const FrameResult frame = run(config);
  const WaypointRows& rows = frame.waypoints;
  size_t hits = 0, wrong = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows.kind[i] != WaypointKind::hit) continue;
    ++hits;
    wrong += glm::distance(rows.position_m[i], corner + size / 2.0) > 1e-9 || rows.surface[i] != 0;
    wrong += rows.depth[i] < 1 || rows.depth[i] > 4;
    // The segment that it is on, where its end is kept: it passes within the radius.
    size_t end = i + 1;
    while (end < rows.size() && rows.kind[end] == WaypointKind::hit) ++end;
    if (rows.depth[i] == 4) continue;
    const glm::dvec3 a = rows.position_m[i - 1], b = rows.position_m[end], p = rows.position_m[i];
    const double u = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    wrong += glm::distance(p, a + u * (b - a)) > 0.5 + 1e-4;
  }
  CHECK(wrong == 0);
  CHECK(hits == frame.counts.receptions);
  CHECK(hits > 20);
}

TEST_CASE("spheres in traffic: a cache of the static scene with exact keys changes nothing") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-40, 2, 6}}, {{40, 3, 1.5}, {-20, -6, 1.5}, {10, 8, 2}}, 12000, 3);
  config.trace.reception = "sphere";
  config.trace.sphere_radius_m = 3;
  config.output.waypoints = 2000;
  add_vehicles(config,
               {{"a", "passenger", {-30, 4, 0}, {12, 0, 0}, 0, 2},
                {"b", "passenger", {20, 0, 0}, {-9, 0, 0}, 0, 2},
                {"c", "truck", {-5, -4, 0}, {7, 0, 0}, 0, 2}},
               0.5);
  config.mounts = {{.name = "roof", .on = "a", .offset_m = {0, 0, 1.7}},
                   {.name = "roof", .on = "b", .offset_m = {0, 0, 1.8}}};
  const auto frames = [&config] {
    Simulation simulation(config);
    std::vector<FrameResult> out;
    for (uint32_t frame = 0; frame < 3; ++frame) out.push_back(simulation.run_frame(frame));
    return out;
  };
  const std::vector<FrameResult> plain = frames();
  REQUIRE(paths_by_vehicles(plain[1].paths) > 0);
  REQUIRE(std::ranges::count_if(plain[1].waypoints.instance, [](uint32_t i) { return i != no_instance; }) > 0);
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    config.cache.kind = kind;
    config.cache.key = "exact";
    const std::vector<FrameResult> cached = frames();
    for (size_t i = 0; i < plain.size(); ++i) {
      CHECK(identical(cached[i].paths, plain[i].paths));
      CHECK(equal(cached[i].waypoints, plain[i].waypoints));
      CHECK(cached[i].counts.receptions == plain[i].counts.receptions);
      CHECK((cached[i].cache.hits > 0) == (i > 0));
    }
  }
}

TEST_CASE("who found where a segment ends: the first frame traces, the second is answered but for vehicles") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-40, 2, 6}}, {{40, 3, 1.5}}, 4000, 3);
  config.output.waypoints = 4000;
  config.trace.reuse = false;
  add_vehicles(config, {{"a", "passenger", {-30, 4, 0}, {12, 0, 0}, 0, 2}}, 0.5);
  const auto counts = [](const WaypointRows& rows) {
    std::array<size_t, 4> out{};
    for (const WaypointSource source : rows.source) ++out[static_cast<size_t>(source)];
    return out;
  };
  Simulation plain(config);
  const WaypointRows without = plain.run_frame(0).waypoints;
  CHECK(counts(without)[0] == 4000);
  CHECK(counts(without)[1] == without.size() - 4000);
  config.cache.kind = "concurrent";
  config.cache.key = "exact";
  config.cache.buffer_size = 65536;
  Simulation cached(config);
  const WaypointRows first = cached.run_frame(0).waypoints, second = cached.run_frame(1).waypoints;
  CHECK(counts(first)[2] == 0);
  CHECK(counts(second)[2] > counts(second)[1]);
  size_t on_vehicles = 0, wrong = 0;
  for (size_t i = 0; i < second.size(); ++i) {
    if (second.instance[i] == no_instance) continue;
    ++on_vehicles;
    wrong += second.source[i] != WaypointSource::traced;
  }
  CHECK(on_vehicles > 0);
  CHECK(wrong == 0);
}
