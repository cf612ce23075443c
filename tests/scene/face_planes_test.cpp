// SPDX-License-Identifier: Apache-2.0
// Planes of surfaces that touch: roofs in pieces have one number, on the side where nothing separates them.
#include "scene/face_planes.hpp"

#include <doctest/doctest.h>

#include <set>

#include "scene/scene_wedges.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Holds the numbers of the planes that look up at a height, and of the surfaces that wedges have there.
struct Roofs {
  std::set<uint32_t> planes, surfaces;
};

Roofs roofs_at(const Scene& s, double z_m, const dvec3& up = {0, 0, 1}) {
  Roofs out;
  for (const Wedge& w : s.wedges) {
    const std::array<dvec3, 2> normals{w.normal,
                                       w.face * std::sin(w.exterior_rad) - w.normal * std::cos(w.exterior_rad)};
    for (size_t face = 0; face < 2; ++face) {
      if (glm::dot(normals[face], up) < 0.99999 || std::abs(glm::dot(s.origin_m + w.start, up) - z_m) > 1e-2) continue;
      out.planes.insert(w.plane[face]);
      out.surfaces.insert(w.surface[face]);
    }
  }
  return out;
}

// Makes a house of 20 x 10 x 8 m without its roof, and the roof as rectangles x0, y0, x1, y1, one mesh each.
std::vector<RawMesh> house_under(const std::vector<std::array<double, 4>>& roof) {
  RawMesh walls = box({-10, -5, 0}, {10, 5, 8});
  walls.triangles.erase(walls.triangles.begin(), walls.triangles.begin() + 2);
  std::vector<RawMesh> out{walls};
  for (const auto& [x, y, end_x, end_y] : roof) out.push_back(quad({x, y, 8}, {end_x - x, 0, 0}, {0, end_y - y, 0}));
  return out;
}

std::vector<RawMesh> laid_down(std::vector<RawMesh> meshes, double angle_rad) {
  for (RawMesh& m : meshes)
    for (dvec3& p : m.vertices)
      p = dvec3(std::cos(angle_rad) * p.x - std::sin(angle_rad) * p.z, p.y,
                std::sin(angle_rad) * p.x + std::cos(angle_rad) * p.z) +
          dvec3(410.3, -77.1, 12.9);
  return meshes;
}

const std::vector<std::array<double, 4>> whole{{-10, -5, 10, 5}}, tee{{-10, -5, 10, 0}, {-10, 0, 1, 5}, {1, 0, 10, 5}};

}  // namespace

TEST_CASE("a roof in pieces that meet in a T, of one material or of two, is one plane") {
  CHECK(roofs_at(build(house_under(whole)), 8).surfaces.size() == 1);
  for (const std::vector<uint32_t>& materials : {std::vector<uint32_t>{0, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 1}}) {
    CAPTURE(materials);
    const Scene s = build(house_under(tee), materials);
    check_contract(s);
    const Roofs roofs = roofs_at(s, 8);
    CHECK(roofs.surfaces.size() >= 2);
    REQUIRE(roofs.planes.size() == 1);
    CHECK(*roofs.planes.begin() == *roofs.surfaces.begin());
  }
}

TEST_CASE("planes in any direction: a house that lies on its side and was moved") {
  const double angle_rad = 0.7;
  const Scene s = build(laid_down(house_under(tee), angle_rad), {0, 0, 1, 0});
  const dvec3 up(-std::sin(angle_rad), 0, std::cos(angle_rad));
  const Roofs roofs = roofs_at(s, 8 + glm::dot(dvec3(410.3, -77.1, 12.9), up), up);
  CHECK(roofs.surfaces.size() >= 2);
  CHECK(roofs.planes.size() == 1);
}

TEST_CASE("planes whose corners were rounded are what they were, a bend that rises by more is one") {
  const auto planes = [](double rise_m) {
    std::vector<RawMesh> roof{quad({0, 0, 5}, {6, 0, 0}, {0, 8, 0}), quad({6, 1, 5}, {7, 0, rise_m}, {0, 6, 0})};
    return roofs_at(build(roof, {0, 1}), 5).planes.size();
  };
  CHECK(planes(0) == 1);
  CHECK(planes(1e-6) == 1);
  CHECK(planes(1.5e-4) == 1);
  CHECK(planes(-1.5e-4) == 1);
  CHECK(planes(3e-4) == 2);
  CHECK(planes(5e-3) == 2);
}

TEST_CASE("roofs of houses that touch are one plane; across a street, or a step, they are not") {
  const auto roofs = [](double gap_m, double step_m) {
    return roofs_at(build({box({0, 0, 0}, {9, 8, 7}), box({9 + gap_m, 1, 0}, {20, 9, 7 + step_m})}, {0, 1}), 7).planes;
  };
  CHECK(roofs(0, 0).size() == 1);
  CHECK(roofs(10, 0).size() == 2);
  CHECK(roofs(0.01, 0).size() == 2);
  CHECK(roofs(0, 5e-3).size() == 2);
}

TEST_CASE("a wall on the seam of two roofs parts them above, not below") {
  std::vector<RawMesh> canopy{quad({0, 0, 4}, {5, 0, 0}, {0, 6, 0}), quad({5, 0, 4}, {5, 0, 0}, {0, 6, 0}),
                              quad({5, 0, 4}, {0, 6, 0}, {0, 0, 2})};
  const Scene s = build(canopy, {0, 1, 0});
  CHECK(roofs_at(s, 4).planes.size() == 2);
  CHECK(roofs_at(s, -4, {0, 0, -1}).planes.size() == 1);
}

TEST_CASE("pieces that overlap are one plane, too") {
  const Scene s = build(house_under({{-10, -5, 2, 5}, {-1, -5, 10, 5}}), {0, 0, 1});
  CHECK(roofs_at(s, 8).surfaces.size() == 2);
  CHECK(roofs_at(s, 8).planes.size() == 1);
}

TEST_CASE("wedges that are found again have the planes that they had") {
  const Scene s = build(house_under(tee), {0, 0, 1, 0});
  Scene again = s;
  find_wedges(again);
  REQUIRE(again.wedges.size() == s.wedges.size());
  for (size_t i = 0; i < s.wedges.size(); ++i) CHECK(again.wedges[i].plane == s.wedges[i].plane);
}
