// SPDX-License-Identifier: Apache-2.0
// Compares the recorder with the scene itself: points on their surfaces, distances, and the law of reflection. Assumes
// that some rays leave the scene, so that queues are compacted; skipped where there is no device.
#include "study/hit_recorder.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <glm/geometric.hpp>
#include "study/worlds.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

constexpr uint32_t ray_count = 5000, depths = 3;

TraceConfig launch() {
  TraceConfig trace;
  trace.rays = ray_count;
  trace.max_depth = depths;
  return trace;
}

Config city() {
  return parse_config(
      "scene.generate = \"--blocks 2\"\n[[transmitter]]\nname = \"a\"\nposition_m = [0, 0, 6]\n"
      "velocity_m_s = [0.01, 0, 0]\n"
      "[[receiver]]\nname = \"b\"\nposition_m = [50, 0, 2]\n",
      "test");
}

bool device_present() { return !gpu::list_devices().empty(); }

}  // namespace

TEST_CASE("points lie on their surfaces, at their distance from the hit before, in the mirrored direction") {
  if (!device_present()) return;
  const glm::dvec3 from{0, 0, 6};
  TracedWorld traced(city(), "");
  HitRecorder record(traced, launch());
  const study::FrameHits hits = record(0, 0);
  REQUIRE(hits.size() == depths);
  uint64_t ended = 0, went_on = 0;
  for (uint32_t ray = 0; ray < ray_count; ++ray) {
    glm::dvec3 at = from - traced.scene.origin_m, mirrored{0};
    double before_m = 0;
    for (uint32_t depth = 0; depth < depths; ++depth) {
      const study::Hit& hit = hits[depth][ray];
      if (!is_hit(hit)) {
        ++ended;
        for (uint32_t later = depth; later < depths; ++later) CHECK_FALSE(is_hit(hits[later][ray]));
        break;
      }
      const Surface& surface = traced.scene.surfaces.at(hit.surface);
      CHECK(traced.scene.triangle_surface.at(hit.primitive) == hit.surface);
      CHECK(std::abs(glm::dot(surface.normal, hit.point_m) - surface.offset_m) < 1e-3);
      CHECK(glm::distance(at, hit.point_m) == doctest::Approx(hit.distance_m).epsilon(1e-4));
      const glm::dvec3 direction = glm::normalize(hit.point_m - at);
      if (before_m > 1 && hit.distance_m > 1) {  // shorter ones do not tell directions
        CHECK(glm::distance(direction, mirrored) < 1e-3);
        ++went_on;
      }
      mirrored = direction - 2 * glm::dot(surface.normal, direction) * surface.normal;
      at = hit.point_m;
      before_m = hit.distance_m;
    }
  }
  CHECK(ended > ray_count / 10);  // so queues were compacted
  CHECK(went_on > ray_count / 10);
}

TEST_CASE("the same transmitter gives the same frame, one that moved a little nearly the same") {
  if (!device_present()) return;
  TracedWorld traced(driven(city(), 2), "");  // 0.1 mm per frame
  HitRecorder record(traced, launch());
  const study::FrameHits first = record(0, 0), moved = record(0, 2), again = record(0, 0);
  for (const study::DepthCoherence& at : study::compare_frames(first, again)) {
    CHECK(at.both == 1);
    CHECK(at.same_sequence == 1);
    CHECK(at.points.total == doctest::Approx(1));
  }
  for (const study::DepthCoherence& at : study::compare_frames(first, moved)) {
    CHECK(at.both > 0.98);
    CHECK(at.same_sequence > 0.98);
    CHECK(at.points.total > 0.98);
  }
  const std::vector<glm::dvec3> a = study::hit_points(first[0]), b = study::hit_points(again[0]);
  CHECK(a == b);
}

TEST_CASE("rays of an antenna on a vehicle pass that vehicle, and meet others where they are in the frame") {
  if (!device_present()) return;
  // Two vans on an open plain: the one ahead leaves, from 10 m away to 30 m.
  const Config config = parse_config(
      "scene.generate = \"--blocks 1\"\n[[mount]]\nname = \"roof\"\noffset_m = [0, 0, 1]\n"
      "[[track]]\nid = \"a\"\ntype = \"passenger\"\nwaypoints = [[0, 0, -53, 0], [1, 0.001, -53, 0]]\n"
      "[[track]]\nid = \"b\"\ntype = \"passenger\"\nwaypoints = [[0, 10, -53, 0], [1, 30, -53, 0]]\n"
      "[time]\nstep_s = 0.5\n",
      "test");
  TracedWorld traced(config, "");
  REQUIRE(traced.world.clock.frame_count() == 3);
  HitRecorder record(traced, launch());
  const uint32_t static_surfaces = static_cast<uint32_t>(traced.scene.surfaces.size()),
                 second = traced.world.fleet.instances.at(1).first_surface;
  double nearest_before_m = 0;
  for (const uint32_t frame : {0u, 1u, 2u}) {
    CAPTURE(frame);
    const glm::dvec3 at = traced.world.state(frame).transmitters[0].position_m;
    double nearest_m = 1e9;
    const study::FrameHits hits = record(0, frame);
    for (const study::Hit& hit : hits[0])
      if (is_hit(hit) && hit.surface >= static_surfaces) {
        CHECK(hit.surface >= second);  // never the own vehicle
        nearest_m = std::min(nearest_m, glm::distance(at, hit.point_m));
      }
    CHECK(nearest_m > 10.0 + 10.0 * frame - 4);  // half a car's length, and some
    CHECK(nearest_m < 10.0 + 10.0 * frame);
    CHECK(nearest_m > nearest_before_m + 5);
    nearest_before_m = nearest_m;
  }
}
