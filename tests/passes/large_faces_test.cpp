// SPDX-License-Identifier: Apache-2.0
// Legs that pass the edge of a large face: they are free on the very side of it on which double has them. Faces of 3 km
// are passed by a hundredth of a millimetre, though float32 rounds the coordinates there to 0.1 mm. In scenes in which
// float32 decides, they are passed by what the fields at edges leave to the legs.
#include <doctest/doctest.h>

#include <random>

#include "passes/image_method.hpp"
#include "passes/occlusion.hpp"
#include "passes/solved_rows.hpp"
#include "passes/transmissions.hpp"
#include "wavetracer/device/path_edges.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using FaceRandom = std::mt19937_64;

double drawn(FaceRandom& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

// A face in any direction; its first side is the edge.
Quad any_face(FaceRandom& random, double size_m) {
  std::normal_distribution<double> normal;
  const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
  const glm::dvec3 along = direction(), up = glm::normalize(glm::cross(along, direction()));
  return {-0.5 * size_m * (along + 0.7 * up), size_m * along, size_m * up};
}

// Past a point of the edge, `inside` metres inside of the face or, where that is negative, outside of it.
PathRow leg_past(FaceRandom& random, const Quad& face, double inside_m) {
  const glm::dvec3 along = glm::normalize(face.u), up = glm::normalize(face.v), across = glm::cross(along, up);
  const glm::dvec3 p = face.corner + drawn(random, 0.1, 0.9) * face.u + inside_m * up;
  const glm::dvec3 way = glm::normalize(drawn(random, -0.8, 0.8) * along + drawn(random, -0.8, 0.8) * up + across);
  return {p - drawn(random, 2, 1000) * way, p + drawn(random, 2, 1000) * way, {}, {}};
}

// size_m: of the faces, and the reach of legs; offs_m: how far legs pass inside of the edge, and outside.
void check_legs_past(double size_m, const std::vector<double>& offs_m) {
  FaceRandom random(7);
  for (uint32_t faces = 0; faces < as_many(6, 2); ++faces) {
    const Quad face = any_face(random, size_m);
    const Scene scene = reference::scene_of_quads({face});
    const DeviceScene uploaded = make_device_scene(context(), scene, false, size_m);
    std::vector<PathRow> rows;
    std::vector<bool> inside;
    for (const double off_m : offs_m)
      for (int i = 0; i < 200; ++i) {
        inside.push_back(i % 2 == 1);
        rows.push_back(leg_past(random, face, inside.back() ? off_m : -off_m));
      }
    Counters counters(context());
    SolvedList list = upload_rows(rows, 8), passed = upload_rows(rows, 8);
    const RadioEnds ends = ends_of(rows);
    Occlusion(context(), uploaded)(uploaded, ends, list, counters, nullptr, {});
    Transmissions(context(), uploaded, 8)(uploaded, ends, passed, counters, {});
    const std::vector<PathRow> seen = download_rows(list), through = download_rows(passed);
    size_t wrong = 0, wrong_through = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      wrong += seen[i].blocked != inside[i];
      wrong_through += (through[i].blocked || !through[i].steps.empty()) != inside[i];
    }
    CHECK(wrong == 0);
    CHECK(wrong_through == 0);
  }
}

}  // namespace

TEST_CASE("what passes the edge of a large face is decided in double") {
  check_legs_past(3000, {1e-5, 3e-5, 1e-4, 3e-4});
}

TEST_CASE("in scenes in which float32 decides, it errs by less than fields at edges leave to it") {
  check_legs_past(largest_scene_of_float32_m, {WT_UNDECIDED_M});
}
