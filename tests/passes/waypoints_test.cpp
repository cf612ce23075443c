// SPDX-License-Identifier: Apache-2.0
// waypoints: rays in a room with a hole, followed through four reflections, against mirrored rays in double.
// Queues shrink and close up on the way, and samples do not count from 0: rows must be those of the right sample.
#include "passes/waypoints.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "passes/interact.hpp"
#include "passes/labelled.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double half_m = 5;

// A cube of half side 5 m whose side at x = 5 is open.
std::vector<Corners> open_room() {
  std::vector<Corners> walls = room(Room::box, 1, half_m);
  std::erase_if(walls, [](const Corners& c) { return c[0].x == half_m && c[1].x == half_m && c[2].x == half_m; });
  return walls;
}

// The points of a ray by the six planes alone; a direction after the last point if it flew out.
struct Polyline {
  std::vector<glm::dvec3> points;
  bool out = false;
  double nearest_edge_m = half_m;  // distance from all points: near an edge rounding decides
};

Polyline follow(glm::dvec3 p, glm::dvec3 d, uint32_t reflections) {
  Polyline line{{p}};
  for (uint32_t k = 0; k < reflections; ++k) {
    double t = 1e9;
    int axis = 0;
    for (int a = 0; a < 3; ++a)
      if (const double to = ((d[a] > 0 ? half_m : -half_m) - p[a]) / d[a]; to < t) {
        t = to;
        axis = a;
      }
    p += t * d;
    for (int a = 0; a < 3; ++a)
      if (a != axis) line.nearest_edge_m = std::min(line.nearest_edge_m, half_m - std::abs(p[a]));
    if (axis == 0 && d.x > 0) {
      line.points.push_back(d);
      line.out = true;
      return line;
    }
    line.points.push_back(p);
    d[axis] = -d[axis];
  }
  return line;
}

// The rows of all samples after `depth` reflections, in the order of `rays`.
std::vector<wt_waypoint> rows_after(const Scene& scene, const std::vector<LabelledRay>& rays, uint32_t depth,
                                    uint32_t first_sample) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  RayQueue queue = upload_labelled(rays), next = upload_labelled(rays);
  HitList hits = upload_hits_of(rays);
  Trace trace_pass(context(), uploaded, shapes().back());
  Scan scan(context());
  Interact interact(context(), {.labels = true});
  Sequences set(context(), 4096);
  Waypoints waypoints(context(), depth);
  waypoints.reserve(rays.size());
  waypoints.begin_batch(first_sample, static_cast<uint32_t>(rays.size()));
  for (uint32_t k = 0; k <= depth && queue.count > 0; ++k) {
    trace_pass(uploaded, queue, hits);
    waypoints(queue, hits, k);
    const uint32_t alive = scan(hits.block_hits, hits.blocks(queue.count));
    interact(uploaded, queue, hits, alive, set.trie(), {.reflected = &next});
    std::swap(queue, next);
  }
  std::vector<uint32_t> samples;
  for (const LabelledRay& ray : rays) samples.push_back(ray.sample);
  return waypoints.rows(samples);
}

}  // namespace

TEST_CASE("every ray's waypoints are where mirrors in double lead it") {
  const Scene scene = scene_of_triangles(open_room());
  for (const uint32_t count : {1u, 17u, 600u})
    for (const uint32_t depth : {0u, 1u, 4u}) {
      CAPTURE(count);
      CAPTURE(depth);
      Random random(count + depth);
      constexpr uint32_t first_sample = 4242;
      std::vector<LabelledRay> rays;
      for (uint32_t i = 0; i < count; ++i)  // samples run backwards through the queue
        rays.push_back({ray_towards(random.in_cube(4), random.direction()), first_sample + count - 1 - i, 0, {}});
      const std::vector<wt_waypoint> rows = rows_after(scene, rays, depth, first_sample);
      REQUIRE(rows.size() == size_t{count} * (depth + 1));
      size_t wrong = 0, out = 0, followed = 0;
      for (uint32_t i = 0; i < count; ++i) {
        const Polyline line = follow(to_double(rays[i].ray.origin), to_double(rays[i].ray.direction), depth);
        if (line.nearest_edge_m < 1e-3) continue;
        ++followed;
        out += line.out;
        for (size_t k = 0; k < line.points.size(); ++k) {
          const wt_waypoint& w = rows[i * size_t{depth + 1} + k];
          const bool miss = line.out && k + 1 == line.points.size();
          if (k == 0)
            wrong += w.surface != WT_WAYPOINT_LAUNCH;
          else if (miss)
            wrong += w.surface != WT_WAYPOINT_MISS;
          else
            wrong += w.surface >= scene.surfaces.size() ||
                     std::abs(glm::dot(scene.surfaces[w.surface].normal, line.points[k]) -
                              scene.surfaces[w.surface].offset_m) > 1e-9;  // the wall that it is on
          wrong += glm::distance(glm::dvec3{w.position[0], w.position[1], w.position[2]}, line.points[k]) > 1e-4;
        }
      }
      CHECK(wrong == 0);
      if (count == 600) CHECK(followed > 550);
      if (count == 600 && depth == 4) CHECK(out > 200);
      if (count == 600 && depth == 4) CHECK(out < followed);
    }
}

TEST_CASE("rows of no sample, of one, and of the same one twice") {
  const Scene scene = scene_of_triangles(open_room());
  const std::vector<LabelledRay> rays{{ray_towards({0, 0, 0}, {0, 0, 1}), 9, 0, {}}};
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  RayQueue queue = upload_labelled(rays);
  HitList hits = upload_hits_of(rays);
  Trace(context(), uploaded, shapes().back())(uploaded, queue, hits);
  Waypoints waypoints(context(), 1);
  waypoints.reserve(1);
  waypoints.begin_batch(9, 1);
  waypoints(queue, hits, 0);
  CHECK(waypoints.rows({}).empty());
  const std::vector<wt_waypoint> twice = waypoints.rows({9, 9});
  REQUIRE(twice.size() == 4);
  CHECK(twice[1].position[2] == doctest::Approx(half_m));
  CHECK(twice[3].surface == twice[1].surface);
}
