// SPDX-License-Identifier: Apache-2.0
// occlusion: a surface blocks a leg that crosses it, if the ends lie on opposite sides of its plane and are not on it.
// Walls 1 mm apart, ends on walls, coplanar patches along a grazing leg; touching_test.cpp has the cases of touching
// surfaces.
#include "passes/occlusion.hpp"

#include <doctest/doctest.h>

#include "passes/image_method.hpp"
#include "passes/solved_rows.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Quad ground(double half) { return {{-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}}; }

bool sees(const std::vector<Quad>& quads, const glm::dvec3& a, const glm::dvec3& b) {
  return Exact(reference::scene_of_quads(quads), {a}, {b}, {}, 1).visible() == 1;
}

// Tells whether there is a path with these reflections without an obstructed leg.
bool reflects(const std::vector<Quad>& quads, const glm::dvec3& a, const glm::dvec3& b,
              const std::vector<uint32_t>& surfaces) {
  const Sequence wanted{0, surfaces};
  const Exact exact(reference::scene_of_quads(quads), {a}, {b}, {wanted}, static_cast<uint32_t>(surfaces.size()));
  return std::any_of(exact.solved.begin(), exact.solved.end(),
                     [&](const SolvedPath& p) { return p.sequence == wanted && !p.blocked; });
}

}  // namespace

TEST_CASE("a wall blocks what crosses it, from either side, and nothing beside or before it") {
  CHECK_FALSE(sees({wall(0)}, {-3, 0.1, 0.2}, {3, 0.3, -0.4}));
  CHECK_FALSE(sees({wall(0)}, {3, 0.3, -0.4}, {-3, 0.1, 0.2}));
  CHECK(sees({wall(0)}, {-3, 2.5, 0}, {3, 2.5, 0}));
  CHECK(sees({wall(0)}, {-3, 0, 0}, {-0.5, 0, 0}));
  CHECK_FALSE(sees({wall(0)}, {-3, 1.9999, 0}, {3, 1.9999, 0}));
  CHECK(sees({wall(0)}, {-3, 2.0001, 0}, {3, 2.0001, 0}));
  CHECK_FALSE(sees({wall(0)}, {-3, 0.5, 0.5}, {3, 0.5, 0.5}));  // through the diagonal
  CHECK(sees({}, {-3, 0.5, 0.5}, {3, 0.5, 0.5}));
}

TEST_CASE("two walls 1 mm apart: a reflection on the front one stands, on the one behind it does not") {
  const std::vector<Quad> walls{wall(0), wall(0.001)};
  CHECK(reflects(walls, {-3, -0.5, 0}, {-2, 0.5, 0.3}, {0}));
  CHECK_FALSE(reflects(walls, {-3, -0.5, 0}, {-2, 0.5, 0.3}, {1}));
  CHECK(reflects(walls, {3, -0.5, 0}, {2, 0.5, 0.3}, {1}));
  CHECK_FALSE(reflects(walls, {3, -0.5, 0}, {2, 0.5, 0.3}, {0}));
  CHECK_FALSE(sees(walls, {-3, 0, 0}, {0.0005, 0, 0}));  // an end between them
  CHECK_FALSE(sees(walls, {0.0005, 0, 0}, {3, 0, 0}));
  CHECK(sees(walls, {0.0005, -1, 0}, {0.0005, 1, 0}));
}

TEST_CASE("the same 1 mm apart, half a kilometre from the origin") {
  const glm::dvec3 far{500, -400, 30};
  std::vector<Quad> walls{wall(0), wall(0.001)};
  for (Quad& w : walls) w.corner += far;
  CHECK(reflects(walls, far + glm::dvec3{-3, -0.5, 0}, far + glm::dvec3{-2, 0.5, 0.3}, {0}));
  CHECK_FALSE(reflects(walls, far + glm::dvec3{-3, -0.5, 0}, far + glm::dvec3{-2, 0.5, 0.3}, {1}));
  CHECK(reflects(walls, far + glm::dvec3{3, -0.5, 0}, far + glm::dvec3{2, 0.5, 0.3}, {1}));
}

TEST_CASE("an end on a surface is not hidden by it") {
  for (const double off : {0.0, 5e-5, -5e-5}) {
    CAPTURE(off);
    CHECK(sees({wall(0)}, {-3, 0, 0}, {off, 0.1, 0.2}));
    CHECK(sees({wall(0)}, {3, 0, 0}, {off, 0.1, 0.2}));
  }
  CHECK_FALSE(sees({wall(0)}, {-3, 0, 0}, {2e-4, 0.1, 0.2}));
  CHECK(sees({ground(50)}, {-20, 3, 0}, {20, -4, 1.5}));  // an antenna on the ground
  CHECK(sees({ground(50)}, {-20, 3, 0}, {20, -4, 0}));    // both of them
}

TEST_CASE("coplanar patches along a grazing leg do not block it") {
  // A road of 50 patches; the leg runs from one reflection point far along it, 1 mm to 1 m above.
  std::vector<Quad> road;
  for (int i = 0; i < 50; ++i) road.push_back({{-50.0 + 2 * i, -5, 0}, {2, 0, 0}, {0, 10, 0}});
  for (const double height : {0.001, 0.01, 0.1, 1.0}) {
    CAPTURE(height);
    CHECK(sees(road, {-49, 0.3, height}, {49, -0.4, height}));
    CHECK(reflects(road, {-49, 0.3, height}, {49, -0.4, height * 1.03}, {24}));
  }
  // A wall that continues in other patches: the reflection at its one end grazes all of them.
  CHECK(reflects(road, {-49, 0, 2}, {49.5, 0, 0.02}, {49}));
}

TEST_CASE("boxes that touch: nothing sees into the seam, and a reflection beside it stands") {
  std::vector<Quad> quads = reference::box_walls({0, 0, 0}, {5, 5, 5});        // 0 .. 5
  const std::vector<Quad> right = reference::box_walls({5, 0, 0}, {9, 5, 5});  // 6 .. 11; its wall 6 lies on wall 1
  quads.insert(quads.end(), right.begin(), right.end());
  CHECK_FALSE(sees(quads, {5, -2, 2}, {5, 7, 2}));  // straight along the seam: the ends lie on neither box
  CHECK_FALSE(sees(quads, {4.7, -2, 2}, {5.3, 7, 2}));
  CHECK(reflects(quads, {3, -4, 2}, {4.9, -3, 2.5}, {2}));
  CHECK(reflects(quads, {5.1, -4, 2}, {8, -3, 2.5}, {8}));
  CHECK_FALSE(reflects(quads, {3, -4, 2}, {4, -3, 2}, {1}));  // the shared wall is inside
  CHECK_FALSE(sees(quads, {2, 2, 2}, {7, 2, 2}));             // from inside one to inside the other
}

TEST_CASE("every leg of a path is tested") {
  // The screen stands between the two reflections of a ground-wall path, or before, or after.
  const Quad back_wall{{10, -10, -1}, {0, 20, 0}, {0, 0, 12}};
  const glm::dvec3 a{0, 0, 3}, b{2, 0, 6};
  const auto path = [&](const Quad& screen) { return reflects({ground(20), back_wall, screen}, a, b, {0, 1}); };
  const auto points = image_method({ground(20), back_wall}, a, {0, 1}, b);
  REQUIRE(points.has_value());
  const auto screen_between = [](const glm::dvec3& p, const glm::dvec3& q) {
    return Quad{(p + q) / 2.0 - glm::dvec3{0, 0.2, 0.2}, {0, 0.4, 0}, {0, 0, 0.4}};
  };
  CHECK(path({{5, 5, 5}, {1, 0, 0}, {0, 1, 0}}));
  CHECK_FALSE(path(screen_between(a, (*points)[0])));
  CHECK_FALSE(path(screen_between((*points)[0], (*points)[1])));
  CHECK_FALSE(path(screen_between((*points)[1], b)));
}

TEST_CASE("a vertex is on the surfaces that its step names, and on no other surface of that number") {
  const Scene scene = reference::scene_of_quads({wall(0), wall(7), wall(9)});
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 10);
  wt_wedge wedge{};
  wedge.face[1] = wedge.normal[0] = wedge.along[2] = 1;
  wedge.cosine = 0, wedge.sine = -1, wedge.exterior = 1.5 * 3.14159265358979;
  wedge.surfaces[0] = 2, wedge.surfaces[1] = 0;  // edge and tile number 0 are on wall 0, edge and tile 1 are not
  wt_wedge other = wedge;
  other.surfaces[1] = 1;
  const gpu::Buffer<wt_wedge> wedges = context().buffer(std::vector{wedge, other}, "wedges");
  const gpu::Buffer<uint32_t> tiles = context().buffer(std::vector<uint32_t>{0, 1}, "tiles");
  std::vector<PathRow> rows;
  for (const uint32_t kind : {WT_STEP_REFLECTION, WT_STEP_DIFFRACTION, WT_STEP_SCATTERING})
    for (const uint32_t number : {0u, 1u, 2u})
      for (const double x : {0.01, 5e-5, 0.0})
        if (kind != WT_STEP_DIFFRACTION || number < 2)
          rows.push_back({{-3, -1, 0}, {-3, 1, 0}, {kind | number}, {{x, 0, 0}}});
  SolvedList list = upload_rows(rows, 1);
  Occlusion occlusion(context(), uploaded);
  Counters counters(context());
  occlusion(uploaded, ends_of(rows), list, counters, nullptr, {&wedges, &tiles});
  std::vector<bool> blocked;
  for (const PathRow& row : download_rows(list)) blocked.push_back(row.blocked);
  // Behind wall 0 by 10 mm, by 0.05 mm and in its plane. A surface in one plane with a surface of the step, to 0.1 mm,
  // counts as that surface; the faces of edge 1 are parallel to wall 0 here. Tile 2 is a cell of vegetation.
  const std::vector<bool> none{false, false, false}, far{true, false, false}, third{true, true, false};
  std::vector<bool> expected;
  for (const auto& part : {none, far, far, none, far, none, far, third})
    expected.insert(expected.end(), part.begin(), part.end());
  CHECK(blocked == expected);
}

namespace {

// Boxes in rows that touch each other, on a ground of patches, at `at`.
std::vector<Quad> terraces(const glm::dvec3& at) {
  std::vector<Quad> quads;
  for (int x = -2; x < 2; ++x)
    for (int y = -2; y < 2; ++y) quads.push_back({at + glm::dvec3{30 * x, 30 * y, 0}, {30, 0, 0}, {0, 30, 0}});
  for (int i = 0; i < 6; ++i)
    for (const double y : {-12.0, 6.0}) {
      const glm::dvec3 low{8 * i - 24, y, 0}, high = low + glm::dvec3{8, 6, 4 + i % 3};
      const std::vector<Quad> box = reference::box_walls(at + low, at + high);
      quads.insert(quads.end(), box.begin(), box.end());
    }
  return quads;
}

// Paths from one place to a grid whose lines run along walls, rims and roofs: lines of sight, then reflections at the
// ground, then those that are bent at an edge, then those that are scattered at the ground. Those of a kind follow each
// other, since only they go together.
std::vector<PathRow> rows_past_terraces(const glm::dvec3& at, const glm::dvec3& from, double step_m) {
  std::vector<PathRow> kinds[4];
  for (const double z : {0.0, 1.5, 4.0, 5.0})
    for (double x = -28; x <= 28; x += step_m)
      for (double y = -16; y <= 16; y += step_m) {
        const glm::dvec3 to{x, y, z};
        const double share = from.z + z > 0 ? from.z / (from.z + z) : 0.5;
        glm::dvec3 p = from + share * (to - from);
        p.z = 0;
        const auto patch = static_cast<uint32_t>(4 * std::floor((p.x + 60) / 30) + std::floor((p.y + 60) / 30));
        const glm::dvec3 on_edge{-22, -6, 4};
        kinds[0].push_back({at + from, at + to, {}, {}});
        kinds[1].push_back({at + from, at + to, {WT_STEP_REFLECTION | patch}, {at + p}});
        kinds[2].push_back({at + from, at + to, {WT_STEP_DIFFRACTION | 0u}, {at + on_edge}});
        kinds[3].push_back({at + from, at + to, {WT_STEP_SCATTERING | patch}, {at + p}});
      }
  std::vector<PathRow> rows;
  for (const std::vector<PathRow>& kind : kinds) rows.insert(rows.end(), kind.begin(), kind.end());
  return rows;
}

// Tests all rows together, and each alone. Returns how many are blocked.
size_t check_rows_alone(const std::vector<Quad>& quads, const glm::dvec3& at, const std::vector<PathRow>& rows,
                        double reach_m) {
  const DeviceScene uploaded = make_device_scene(context(), reference::scene_of_quads(quads), false, reach_m);
  wt_wedge wedge{};  // an edge of the first box, along x
  for (int axis = 0; axis < 3; ++axis) wedge.start[axis] = at[axis] + glm::dvec3{-24, -6, 4}[axis];
  wedge.along[0] = 1;
  wedge.face[2] = -1;
  wedge.normal[1] = 1;
  wedge.length = 8;
  wedge.cosine = 0, wedge.sine = -1, wedge.exterior = 1.5 * 3.14159265358979;
  wedge.surfaces[0] = 16 + 3, wedge.surfaces[1] = 16 + 5;
  const gpu::Buffer<wt_wedge> wedges = context().buffer(std::vector{wedge}, "wedges");
  std::vector<uint32_t> patches(16);
  for (uint32_t i = 0; i < patches.size(); ++i) patches[i] = i;
  const gpu::Buffer<uint32_t> tiles = context().buffer(patches, "tiles");
  Occlusion occlusion(context(), uploaded);
  Counters counters(context());
  SolvedList list = upload_rows(rows, 1);
  occlusion(uploaded, ends_of(rows), list, counters, nullptr, {&wedges, &tiles});
  const std::vector<PathRow> together = download_rows(list);
  size_t blocked = 0, wrong = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    SolvedList one = upload_rows({rows[i]}, 1);
    occlusion(uploaded, ends_of({rows[i]}), one, counters, nullptr, {&wedges, &tiles});
    wrong += download_rows(one)[0].blocked != together[i].blocked;
    blocked += together[i].blocked;
  }
  CHECK(wrong == 0);
  return blocked;
}

}  // namespace

TEST_CASE("legs that are tested together are free exactly where each is free alone") {
  const double step_m = as_many(2, 8);
  for (const glm::dvec3& at : {glm::dvec3{0, 0, 0}, glm::dvec3{1700, -2300, 12}})  // float32 decides, or double
    for (const glm::dvec3& from : {glm::dvec3{-20, 1, 1.5}, glm::dvec3{3.1, -3.3, 9}, glm::dvec3{-24, -6, 4}}) {
      CAPTURE(at.x);
      CAPTURE(from.x);
      const std::vector<PathRow> rows = rows_past_terraces(at, from, step_m);
      const size_t blocked = check_rows_alone(terraces(at), at, rows, 3000 * (at.x != 0) + 60);
      CHECK(blocked > rows.size() / 10);
      CHECK(blocked < rows.size() * 9 / 10);
    }
}
