// SPDX-License-Identifier: Apache-2.0
// beam_moving: an aperture from which some of an instance's box can be seen past the static world is among those that
// are found, and one is not from which all boxes are outside of its beam or behind one wall.
#include "passes/beam_moving.hpp"

#include "passes/beams.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Is a point in sight of the origin through a window? A wall in the plane x = 3 hides what is behind its rectangle.
struct Sight {
  double low_y, high_y, low_z, high_z;        // the window
  double wall_low_y, wall_high_y, wall_high;  // the wall, from z = -wall_high to wall_high
  bool through(const glm::dvec3& p, double room) const {
    const double y = p.y / p.x, z = p.z / p.x;
    return p.x > 0 && y > low_y - room && y < high_y + room && z > low_z - room && z < high_z + room;
  }
  bool behind(const glm::dvec3& p, double room) const {
    const double y = 3 * p.y / p.x, z = 3 * p.z / p.x;
    return p.x > 3 + room && y > wall_low_y + room && y < wall_high_y - room && std::abs(z) < wall_high - room;
  }
};

constexpr Sight half_open{-0.8, 0.9, -0.5, 0.7, -9, 0.4, 7};

std::vector<Corners> wall(const Sight& s) {
  const glm::dvec3 a(3, s.wall_low_y, -s.wall_high), b(3, s.wall_high_y, -s.wall_high),
      c(3, s.wall_high_y, s.wall_high), d(3, s.wall_low_y, s.wall_high);
  return {{a, b, c}, {a, c, d}};
}

wt_instance_box box_at(const glm::dvec3& centre, const glm::dvec3& half) {
  const glm::dvec3 low = centre - half, high = centre + half;
  return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

}  // namespace

TEST_CASE("beam_moving: screens hide nothing beyond the reach that they were made for") {
  const Sight& s = half_open;
  const Scene scene = scene_of_triangles(wall(s));
  const DeviceScene device = make_device_scene(context(), scene, false);
  const BeamTree tree = make_beam_tree(context(), WorldFacets(scene, {}).fixed());
  BeamLists lists(context());
  const wt_aperture one = window(-0.5, 0, -0.2, 0.3);  // the wall fills it
  lists.apertures = context().buffer(std::vector<wt_aperture>(2, one), "apertures");
  KeptApertures kept{.apertures = context().buffer(std::vector<wt_aperture>(1, one), "apertures"),
                     .outlooks = context().buffer<wt_outlook>(1, "outlooks"),
                     .count = 1};
  BeamGather(context(), tree.depth)(tree, device, lists, 0, 1, {.outlooks = &kept.outlooks}, 1 << 12);
  const float reach = kept.outlooks.read_one(0, Stage::beam_gather).reach;
  CHECK(reach > 7);
  CHECK(reach < 30);
  BeamMoving moving(context());
  // Along a line that does not meet the diagonal between the wall's two halves.
  for (const double x : {4.0, 6.0, 60.0, 6000.0}) {
    CAPTURE(x);
    moving.place({box_at(x * glm::dvec3(1, -0.4, 0.2), glm::dvec3(0.01))});
    CHECK(moving(device, kept, lists, 1, 0) == (x < 10 ? 1 : 2));
  }
}

TEST_CASE("beam_moving: an aperture is found if and only if a box may be seen from it") {
  // One facet per triangle: two surfaces hide the wall's halves, so boxes are small, and those on its diagonal are left
  // out below.
  const Sight& s = half_open;
  const Scene scene = scene_of_triangles(wall(s));
  const DeviceScene device = make_device_scene(context(), scene, false);
  const BeamTree tree = make_beam_tree(context(), WorldFacets(scene, {}).fixed());
  BeamLists lists(context());
  const wt_aperture one = window(s.low_y, s.high_y, s.low_z, s.high_z);
  lists.apertures = context().buffer(std::vector<wt_aperture>(3, one), "apertures");
  KeptApertures kept{.apertures = context().buffer(std::vector<wt_aperture>(3, one), "apertures"),
                     .outlooks = context().buffer<wt_outlook>(3, "outlooks"),
                     .count = 3};
  BeamGather(context(), tree.depth)(tree, device, lists, 0, 3, {.outlooks = &kept.outlooks}, 1 << 12);
  BeamMoving moving(context());
  Random random(5);
  size_t seen = 0, hidden = 0, outside = 0;
  for (uint32_t i = 0; i < as_many(2000, 60); ++i) {
    const glm::dvec3 centre(random.between(-4, 9), random.between(-6, 6), random.between(-5, 5)),
        half(random.between(0.01, 0.3), random.between(0.01, 0.3), random.between(0.01, 0.3));
    bool some = false, all_behind = true, none_through = true;
    for (int k = 0; k < 27; ++k) {
      const glm::dvec3 p = centre + half * glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      some = some || (s.through(p, -1e-4) && !s.behind(p, -1e-4));
      all_behind = all_behind && s.behind(p, 0.35);
      none_through = none_through && !s.through(p, 0.6);
    }
    moving.place({box_at(centre, half)});
    const uint32_t found = moving(device, kept, lists, 1, 0);
    CAPTURE(i);
    REQUIRE((found == 1 || found == 4));  // after the first one of the list
    if (some) CHECK(found == 4);
    const double diagonal = std::abs(
        3 * centre.z / centre.x -
        (3 * centre.y / centre.x - s.wall_low_y) * (2 * s.wall_high) / (s.wall_high_y - s.wall_low_y) + s.wall_high);
    if (all_behind && !none_through && centre.x > 3.4 && diagonal > 1.5) CHECK(found == 1);
    if (centre.x < -0.4) CHECK(found == 1);
    seen += some;
    hidden += all_behind && found == 1;
    outside += centre.x < -0.4;
    if (found == 4) {
      const std::vector<wt_aperture> list = lists.apertures.read(0, 4);
      for (uint32_t k = 1; k < 4; ++k) {
        CHECK(list[k].only_moving != 0);
        CHECK(list[k].deepest >= static_cast<float>(centre.x + half.x));
        CHECK(list[k].low_u <= list[k].high_u);
      }
    }
  }
  CHECK(seen > as_many(50, 1));
  CHECK(hidden > as_many(50, 1));
  CHECK(outside > as_many(50, 1));
}

TEST_CASE("beam_moving: without boxes, without apertures, and behind too many walls nothing is found") {
  const Scene scene = scene_of_triangles(wall(half_open));
  const DeviceScene device = make_device_scene(context(), scene, false);
  const BeamTree tree = make_beam_tree(context(), WorldFacets(scene, {}).fixed());
  BeamLists lists(context());
  wt_aperture one = window(-1, 1, -1, 1);
  one.passed = 2;
  lists.apertures = context().buffer(std::vector{one}, "apertures");
  KeptApertures kept{.apertures = context().buffer(std::vector{one}, "apertures"),
                     .outlooks = context().buffer<wt_outlook>(1, "outlooks"),
                     .count = 1};
  BeamGather(context(), tree.depth)(tree, device, lists, 0, 1, {.walls = 2, .outlooks = &kept.outlooks}, 1 << 12);
  BeamMoving moving(context());
  CHECK(moving(device, kept, lists, 1, 2) == 1);
  moving.place({box_at({2, 0, 0}, glm::dvec3(0.1))});
  CHECK(moving(device, kept, lists, 1, 2) == 2);
  CHECK(moving(device, kept, lists, 1, 1) == 1);
  CHECK(moving(device, {}, lists, 1, 2) == 1);
}
