// SPDX-License-Identifier: Apache-2.0
// Tests wedges of meshes whose edges are known by hand; each is also checked against all triangles around it.
// Scenes consist of separate meshes, welded along their sides or not, so that most edges have faces of several meshes.
#include "scene/scene_wedges.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "scene/info.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Approx;

TEST_CASE("a box has 12 edges of 270 degrees") {
  const Scene s = build({box({0, 0, 0}, {4, 3, 2})});
  check_contract(s);
  CHECK(s.wedges.size() == 12);
  CHECK(total_length_m(s) == Approx(4 * (4 + 3 + 2)));
  for (const Wedge& w : s.wedges) CHECK(w.exterior_rad == Approx(1.5 * pi).epsilon(1e-15));
  CHECK(diffracts(s, {0, 0, 2}, {4, 0, 2}, 270));
  CHECK(s.report.flat_pieces == 0);
  CHECK(s.report.corner_pieces == 0);
}

TEST_CASE("wedges from 10 to 179 degrees, whichever way their faces are wound") {
  for (const double interior_deg : {10.0, 90.0, 170.0, 179.0}) {
    for (const bool flipped : {false, true}) {
      const dvec3 second(std::cos(interior_deg * degree) * 5, std::sin(interior_deg * degree) * 5, 0);
      const dvec3 up(0, 0, 3);
      const RawMesh face = flipped ? quad(up, second, -up) : quad({0, 0, 0}, second, up);
      const Scene s = build({quad({0, 0, 0}, {5, 0, 0}, up), face});
      check_contract(s);
      CHECK(s.wedges.size() == (interior_deg == 90 ? 7 : 8));  // and the corner on the other side
      CHECK(free_count(s) == 6);
      CHECK(diffracts(s, {0, 0, 0}, up, 360 - interior_deg));
      CHECK(diffracts(s, {0, 0, 0}, up, interior_deg) == (interior_deg != 90));
    }
  }
}

TEST_CASE("boxes that share a wall: nothing at it, and edges run across both") {
  const Scene s = build({box({0, 0, 0}, {4, 3, 2}), box({4, 0, 0}, {8, 3, 2})});
  check_contract(s);
  CHECK(s.wedges.size() == 12);
  CHECK(diffracts(s, {0, 0, 2}, {8, 0, 2}, 270));
  CHECK(s.report.corner_pieces == 4);
}

TEST_CASE("boxes that share an edge: four right angles") {
  const Scene diagonal = build({box({0, 0, 0}, {4, 3, 2}), box({4, 3, 0}, {8, 6, 2})});
  check_contract(diagonal);
  CHECK(diagonal.wedges.size() == 22);
  CHECK(diagonal.report.corner_pieces == 1);
  CHECK_FALSE(between(diagonal, {4, 3, 0}, {4, 3, 2}));
}

TEST_CASE("a small box on the side of a large one, not welded to it") {
  const Scene s = build({box({0, 0, 0}, {4, 10, 6}), box({4, 3, 0}, {6, 7, 3})});
  check_contract(s);
  CHECK(s.wedges.size() == 21);  // 12 and one more, as the foot of the large wall is cut; 12 - 4
  CHECK(s.report.corner_pieces == 4);
  CHECK(diffracts(s, {4, 0, 0}, {4, 3, 0}, 270));
  CHECK(diffracts(s, {4, 7, 0}, {4, 10, 0}, 270));
  CHECK(diffracts(s, {4, 0, 6}, {4, 10, 6}, 270));
  CHECK(diffracts(s, {4, 3, 3}, {6, 3, 3}, 270));
  CHECK_FALSE(between(s, {4, 3, 3}, {4, 7, 3}));
}

TEST_CASE("a tall box on the side of a lower, longer one: their edges cross") {
  const Scene s = build({box({0, 0, 0}, {4, 10, 6}), box({4, 2, 0}, {8, 8, 9})});
  check_contract(s);
  CHECK(s.wedges.size() == 25);
  CHECK(diffracts(s, {4, 2, 6}, {4, 2, 9}, 270));  // above the roof of the other
  CHECK(diffracts(s, {4, 8, 6}, {4, 8, 9}, 270));
  CHECK(diffracts(s, {4, 0, 6}, {4, 2, 6}, 270));
  CHECK(diffracts(s, {4, 8, 6}, {4, 10, 6}, 270));
  CHECK(diffracts(s, {4, 2, 9}, {4, 8, 9}, 270));
  CHECK_FALSE(between(s, {4, 2, 6}, {4, 8, 6}));
}

TEST_CASE("a box on the ground: its feet do not diffract") {
  for (const bool with_bottom : {true, false}) {
    const Scene s = build({quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}), box({-3, -2, 0}, {2, 4, 5}, with_bottom)});
    check_contract(s);
    CHECK(s.wedges.size() == 12);
    CHECK(free_count(s) == 4);
    CHECK(s.report.corner_pieces == 4);
    CHECK(diffracts(s, {-3, -2, 0}, {-3, -2, 5}, 270));
    CHECK(diffracts(s, {-3, -2, 5}, {2, -2, 5}, 270));
    CHECK(diffracts(s, {-10, -10, 0}, {10, -10, 0}, 360));
  }
  const Scene open = build({quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}), box({-3, -2, 0.05}, {2, 4, 5}, false)});
  CHECK(free_count(open) == 8);  // 5 cm above the ground the feet are edges in the air
  // Half of the wall is on the ground: its foot is a free edge only where the ground ends.
  const Scene half = build({quad({0, -10, 0}, {20, 0, 0}, {0, 20, 0}), quad({-3, 0, 0}, {6, 0, 0}, {0, 0, 2})});
  check_contract(half);
  CHECK(diffracts(half, {-3, 0, 0}, {0, 0, 0}, 360));
  CHECK_FALSE(between(half, {0, 0, 0}, {3, 0, 0}));
  CHECK(half.report.corner_pieces == 1);
}

TEST_CASE("a concave edge diffracts on its back side") {
  const Scene s = build({l_building()});
  check_contract(s);
  CHECK(s.wedges.size() == 18);
  REQUIRE(diffracts(s, {2, 2, 0}, {2, 2, 3}, 270));
  const Wedge& concave = *between(s, {2, 2, 0}, {2, 2, 3});
  const dvec3 bisector = concave.face * std::cos(135 * degree) + concave.normal * std::sin(135 * degree);
  CHECK(glm::distance(bisector, glm::normalize(dvec3(-1, -1, 0))) < 1e-12);  // into the building
}

TEST_CASE("coplanar quads of two materials: flat between them, their outlines stay apart") {
  const Scene s = build({quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0}), quad({10, 0, 0}, {5, 0, 0}, {0, 10, 0})}, {0, 1});
  check_contract(s);
  CHECK(s.wedges.size() == 6);
  CHECK(free_count(s) == 6);
  CHECK(diffracts(s, {0, 0, 0}, {10, 0, 0}, 360));
  // The same meshes, not welded along the side: the border is then a flat piece of its own.
  const Scene loose = build({quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0}), quad({10, 2, 0}, {5, 0, 0}, {0, 6, 0})}, {0, 1});
  check_contract(loose);
  CHECK(loose.report.flat_pieces == 1);
  CHECK(loose.wedges.size() == 8);
}

TEST_CASE("three and four faces at an edge") {
  const auto fan = [](std::vector<double> angles_deg) {
    std::vector<RawMesh> meshes;
    for (const double a : angles_deg)
      meshes.push_back(quad({0, 0, 0}, {5 * std::cos(a * degree), 5 * std::sin(a * degree), 0}, {0, 0, 3}));
    return build(meshes);
  };
  for (const auto& angles : {std::vector<double>{0, 90, 180}, {0, 90, 180, 270}}) {
    const Scene s = fan(angles);
    check_contract(s);
    CHECK(s.report.corner_pieces == 1);
    CHECK_FALSE(between(s, {0, 0, 0}, {0, 0, 3}));
  }
  const Scene thirds = fan({0, 120, 240});
  check_contract(thirds);
  CHECK(thirds.report.corner_pieces == 0);
  CHECK(std::ranges::count_if(thirds.wedges, [](const Wedge& w) { return w.exterior_rad < pi; }) == 3);
  const Scene s = fan({50, 110, 20});  // the one in the middle is behind the others
  check_contract(s);
  for (const double sector_deg : {30, 60}) CHECK(diffracts(s, {0, 0, 0}, {0, 0, 3}, sector_deg));
  REQUIRE(diffracts(s, {0, 0, 0}, {0, 0, 3}, 270));
  const Wedge& w = *between(s, {0, 0, 0}, {0, 0, 3}, 1e-9, 270);
  const std::array<uint32_t, 2> objects{s.surfaces[w.surface[0]].object, s.surfaces[w.surface[1]].object};
  CHECK(std::min(objects[0], objects[1]) == 1);
  CHECK(std::max(objects[0], objects[1]) == 2);
}

TEST_CASE("pieces in a row are one wedge, across vertices that only one mesh has") {
  // A wall of one quad, 10 m long, and a roof of two strips that meet at 4 m.
  const RawMesh wall = quad({0, 0, 0}, {10, 0, 0}, {0, 0, 3});
  const RawMesh roof = mesh({{0, 0, 3}, {4, 0, 3}, {10, 0, 3}, {0, 5, 3}, {4, 5, 3}, {10, 5, 3}},
                            {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  const Scene s = build({wall, roof});
  check_contract(s);
  CHECK(s.wedges.size() == 7);
  CHECK(diffracts(s, {0, 0, 3}, {10, 0, 3}, 270));
  CHECK(diffracts(s, {0, 5, 3}, {10, 5, 3}, 360));
  // The material changes at 4 m: two surfaces, so two wedges.
  const RawMesh near = quad({0, 0, 3}, {4, 0, 0}, {0, 5, 0}), far = quad({4, 0, 3}, {6, 0, 0}, {0, 5, 0});
  const Scene two = build({wall, near, far}, {0, 0, 1});
  check_contract(two);
  CHECK(diffracts(two, {0, 0, 3}, {4, 0, 3}, 270));
  CHECK(diffracts(two, {4, 0, 3}, {10, 0, 3}, 270));
  CHECK(two.wedges.size() == 9);
}

TEST_CASE("a free edge that goes on along the other side of its sheet is two") {
  // Cells of a plane around an empty one; the first and the last meet in one vertex.
  std::vector<RawMesh> cells;
  for (const dvec3& corner : {dvec3(0), {0, -1, 0}, {1, -1, 0}, {2, -1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}})
    cells.push_back(quad(corner, {1, 0, 0}, {0, 1, 0}));
  const Scene s = build(cells);
  check_contract(s);
  CHECK(s.surfaces.size() == 1);
  CHECK(diffracts(s, {0, 1, 0}, {1, 1, 0}, 360));
  CHECK(diffracts(s, {1, 1, 0}, {2, 1, 0}, 360));
}

TEST_CASE("the rim of a disc does not become one straight edge") {
  RawMesh disc;
  const uint32_t sides = 3600;
  const double radius_m = 20;
  disc.vertices.emplace_back(0);
  for (uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * pi * i / sides;
    disc.vertices.emplace_back(radius_m * std::cos(a), radius_m * std::sin(a), 0);
    disc.triangles.push_back({0, i + 1, (i + 1) % sides + 1});
  }
  const Scene s = build({disc});
  CHECK(free_count(s) == s.wedges.size());
  CHECK(s.wedges.size() > 200);
  CHECK(s.wedges.size() < 400);
  CHECK(total_length_m(s) == Approx(2 * pi * radius_m).epsilon(1e-4));
  for (const Wedge& w : s.wedges) {  // a chord, or within 2 mm of one
    CHECK(std::abs(glm::length(w.start + s.origin_m) - radius_m) < 2.1e-3);
    CHECK(std::abs(glm::length(end_of(w) + s.origin_m) - radius_m) < 2.1e-3);
  }
}

TEST_CASE("where a scene is, how large and how it is turned does not matter") {
  const auto scene = [](const std::function<dvec3(const dvec3&)>& moved) {
    std::vector<RawMesh> meshes{quad({-30, -30, 0}, {60, 0, 0}, {0, 60, 0}), l_building(),
                                box({4, 0.5, 0}, {7, 1.5, 5}), box({-6, 0, 0}, {0, 5, 2}),
                                quad({-10, -10, 1}, {3, 1, 0}, {0, 0, 2})};
    for (RawMesh& m : meshes) {
      for (dvec3& v : m.vertices) v = moved(v);
    }
    return build(meshes, {1, 0, 0, 0, 1});
  };
  const Scene here = scene([](const dvec3& p) { return p; });
  check_contract(here);
  CHECK(here.report.corner_pieces > 10);
  const dvec3 utm(691608, 5334760, 512);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(dvec3(1, 2, -0.5)));
  const std::vector<std::function<dvec3(const dvec3&)>> moves{
      [&](const dvec3& p) { return p + utm; }, [](const dvec3& p) { return p * 100.0; },
      [](const dvec3& p) { return p * 0.1; }, [&](const dvec3& p) { return dvec3(turn * glm::dvec4(p, 1)); }};
  for (size_t i = 0; i < moves.size(); ++i) {
    CAPTURE(i);
    const Scene there = scene(moves[i]);
    CHECK(there.wedges.size() == here.wedges.size());
    CHECK(there.report.corner_pieces == here.report.corner_pieces);
    CHECK(there.report.flat_pieces == here.report.flat_pieces);
    for (const Wedge& w : here.wedges) {
      const dvec3 a = moves[i](w.start + here.origin_m), b = moves[i](end_of(w) + here.origin_m);
      const Wedge* same = between(there, a, b, 1e-8);
      REQUIRE(same);
      CHECK(same->exterior_rad == Approx(w.exterior_rad).epsilon(1e-12));
      CHECK(is_free(*same) == is_free(w));
    }
  }
}

TEST_CASE("found again they are the same, and a stretched scene has the angles of its new shape") {
  Scene s = build({quad({0, 0, 0}, {4, 0, 4}, {0, 5, 0}), quad({0, 0, 0}, {-4, 0, 4}, {0, 5, 0})});
  REQUIRE(diffracts(s, {0, 0, 0}, {0, 5, 0}, 270));
  const std::vector<Wedge> before = s.wedges;
  find_wedges(s);
  REQUIRE(s.wedges.size() == before.size());
  for (size_t i = 0; i < before.size(); ++i) CHECK(s.wedges[i].start == before[i].start);
  const dvec3 scale(std::sqrt(3.0), 1, 1);  // planes are scaled as well: dot(n, p) = d is dot(n / scale, scale p) = d
  for (dvec3& v : s.vertices) v *= scale;
  for (Surface& surface : s.surfaces) {
    const dvec3 normal = surface.normal / scale;
    surface.normal = glm::normalize(normal);
    surface.offset_m /= glm::length(normal);
  }
  s.origin_m *= scale;
  find_wedges(s);
  check_contract(s);
  CHECK(diffracts(s, {0, 0, 0}, {0, 5, 0}, 240));
}

TEST_CASE("scene info counts edges that diffract and lists them") {
  const Scene s = build({quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}), box({-3, -2, 0}, {2, 4, 5})}, {0, 1});
  const std::string text = describe_scene(s);
  CHECK(text.find("diffract   12 edges: 8 wedges, 4 free\n") != std::string::npos);
  // The floor of the box is cut out of the ground, so the borders between pieces of the ground are flat.
  CHECK(text.find("left out: 8 pieces flat with another mesh, 6 in corners of right angles (feet of walls)") !=
        std::string::npos);
  CHECK(text.find("\ncovered    30 m2 of surfaces") != std::string::npos);
  const std::string list = describe_edges(s);
  CHECK(std::count(list.begin(), list.end(), '\n') == 13);
  CHECK(list.substr(0, 7) == "   edge");
  CHECK(list.find("   5.000       90.00  ") != std::string::npos);  // a corner of the box
  CHECK(list.find("  20.000        0.00  0 concrete\n") != std::string::npos);
  CHECK(list.find(" brick, ") != std::string::npos);
}
