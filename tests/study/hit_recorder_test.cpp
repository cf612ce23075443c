// The recorder against the scene itself: points on their surfaces, distances, and the law of reflection.
// Assumes that some rays leave the scene, so that queues are compacted; skipped where there is no device.
#include "study/hit_recorder.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <glm/geometric.hpp>
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
      "[[receiver]]\nname = \"b\"\nposition_m = [50, 0, 2]\n",
      "test");
}

bool device_present() { return !gpu::list_devices().empty(); }

}  // namespace

TEST_CASE("points lie on their surfaces, at their distance from the hit before, in the mirrored direction") {
  if (!device_present()) return;
  const glm::dvec3 from{0, 0, 6};
  TracedScene traced(city(), "", {from});
  HitRecorder record(traced, launch());
  const study::FrameHits hits = record(from);
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
  const glm::dvec3 from{0, 0, 6}, to{0.001, 0, 6};
  TracedScene traced(city(), "", {from, to});
  HitRecorder record(traced, launch());
  const study::FrameHits first = record(from), moved = record(to), again = record(from);
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
