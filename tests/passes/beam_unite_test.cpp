// SPDX-License-Identifier: Apache-2.0
// beam_unite: parts of a mirror that make up convex ones are put together, whatever their order in the list, and every
// point of a part stays in one of them.
#include "passes/beam_unite.hpp"

#include <algorithm>

#include "passes/beams.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Polygon = std::vector<glm::dvec2>;

// The part of the mirror x = 2 with these corners (y, z), whose image is at x = 4, for a node.
wt_aperture part_of(const Polygon& corners, uint32_t node) {
  wt_aperture out{};
  out.image[0] = 4;
  out.image[1] = 0.3;
  for (size_t i = 0; i < corners.size(); ++i) {
    out.corners[3 * i] = 2;
    out.corners[3 * i + 1] = corners[i].x;
    out.corners[3 * i + 2] = corners[i].y;
  }
  out.count = static_cast<wt_uint>(corners.size());
  out.node = node;
  out.surface = 0;
  out.own = WT_NONE;
  out.kept = 0.5f;
  return out;
}

Polygon rectangle(double low_y, double high_y, double low_z, double high_z) {
  return {{low_y, low_z}, {high_y, low_z}, {high_y, high_z}, {low_y, high_z}};
}

double area_of(const wt_aperture& a) {
  double area = 0;
  for (uint32_t i = 2; i < a.count; ++i) {
    const double *o = a.corners, *p = a.corners + 3 * (i - 1), *q = a.corners + 3 * i;
    area += (p[1] - o[1]) * (q[2] - o[2]) - (q[1] - o[1]) * (p[2] - o[2]);
  }
  return std::abs(area) / 2;
}

bool contains(const wt_aperture& a, const glm::dvec2& p) {
  int left = 0, right = 0;
  for (uint32_t i = 0; i < a.count; ++i) {
    const double *b = a.corners + 3 * i, *c = a.corners + 3 * ((i + 1) % a.count);
    const double turn = (c[1] - b[1]) * (p.y - b[2]) - (p.x - b[1]) * (c[2] - b[2]);
    left += turn >= -1e-12;
    right += turn <= 1e-12;
  }
  return left == static_cast<int>(a.count) || right == static_cast<int>(a.count);
}

// The apertures that a list becomes, in the order of their nodes and corners.
std::vector<wt_aperture> united(const std::vector<wt_aperture>& apertures) {
  const std::vector<Corners> mirror{Corners{glm::dvec3(2, -9, -9), glm::dvec3(2, 29, -9), glm::dvec3(2, -9, 29)}};
  const Scene scene = scene_of_triangles(mirror);
  const DeviceScene device = make_device_scene(context(), scene, false);
  BeamLists lists(context());
  lists.next = context().buffer(apertures, "apertures");
  lists.apertures = context().buffer<wt_aperture>(1, "apertures");  // it must grow
  Sequences set(context(), 64);
  set.clear();
  BeamUnite unite(context());
  const auto count = static_cast<uint32_t>(apertures.size());
  std::vector<wt_aperture> out;
  for (int again = 0; again < 2; ++again) {  // nothing is left of the call before
    lists.counters.write(std::vector<wt_beam_counters>(1), 0, Stage::beam_visible);
    const uint32_t left = unite(device, lists, count, set.trie());
    CHECK(lists.counters.read_one(0, Stage::beam_visible).apertures == 0);
    if (again) CHECK(left == out.size());
    out = lists.apertures.read(0, left);
  }
  std::ranges::sort(out, [](const wt_aperture& a, const wt_aperture& b) {
    return a.node != b.node ? a.node < b.node : std::ranges::lexicographical_compare(a.corners, b.corners);
  });
  return out;
}

// The parts of a rectangle that n random lines leave, each cut by all of them.
std::vector<Polygon> cut(const Polygon& whole, uint32_t lines, uint32_t seed) {
  Random random(seed);
  std::vector<Polygon> parts{whole};
  for (uint32_t k = 0; k < lines; ++k) {
    const double angle = random.between(0, 6.2), a = std::cos(angle), b = std::sin(angle),
                 c = -a * random.between(-1, 1) - b * random.between(-1, 1);
    std::vector<Polygon> next;
    for (const Polygon& part : parts) {
      Polygon in, out;
      for (size_t i = 0; i < part.size(); ++i) {
        const glm::dvec2 p = part[i], q = part[(i + 1) % part.size()];
        const double at_p = a * p.x + b * p.y + c, at_q = a * q.x + b * q.y + c;
        (at_p >= 0 ? in : out).push_back(p);
        if ((at_p >= 0) == (at_q >= 0)) continue;
        const glm::dvec2 cross = p + (q - p) * (at_p / (at_p - at_q));
        in.push_back(cross);
        out.push_back(cross);
      }
      for (const Polygon& piece : {in, out})
        if (piece.size() >= 3) next.push_back(piece);
    }
    parts = next;
  }
  return parts;
}

}  // namespace

TEST_CASE("beam_unite: parts that share a whole side become one, those of other sequences and walls do not") {
  const std::vector<wt_aperture> halves{part_of(rectangle(-1, 0.1, -1, 1), 5), part_of(rectangle(0.1, 1, -1, 1), 5)};
  const std::vector<wt_aperture> one = united(halves);
  REQUIRE(one.size() == 1);
  CHECK(one[0].count == 4);
  CHECK(area_of(one[0]) == doctest::Approx(4).epsilon(1e-12));
  CHECK(one[0].image[0] == 4);
  CHECK(one[0].node == 5);
  std::vector<wt_aperture> other = halves;
  other[1].node = 6;
  CHECK(united(other).size() == 2);
  other[1].node = 5;
  other[1].passed = 1;
  CHECK(united(other).size() == 2);
  other[1].passed = 0;
  other[1].kept = 0.75f;
  const std::vector<wt_aperture> most = united(other);
  REQUIRE(most.size() == 1);
  CHECK(most[0].kept == 0.75f);
}

TEST_CASE("beam_unite: what would not be convex stays apart, with the same corners") {
  // An L, a rectangle with a hole in its middle, and two parts with a gap.
  const std::vector<wt_aperture> corner{part_of(rectangle(-1, 0, -1, 1), 5), part_of(rectangle(0, 1, -1, 0), 5)};
  CHECK(united(corner).size() == 2);
  const std::vector<wt_aperture> ring{part_of(rectangle(-1, 1, -1, -0.5), 5), part_of(rectangle(-1, 1, 0.5, 1), 5),
                                      part_of(rectangle(-1, -0.5, -0.5, 0.5), 5),
                                      part_of(rectangle(0.5, 1, -0.5, 0.5), 5)};
  const std::vector<wt_aperture> same = united(ring);
  REQUIRE(same.size() == 4);
  for (const wt_aperture& a : same)
    CHECK(std::ranges::count_if(ring, [&](const wt_aperture& b) { return std::ranges::equal(a.corners, b.corners); }) ==
          1);
  CHECK(united({part_of(rectangle(-1, 0, -1, 1), 5), part_of(rectangle(0.3, 1, -1, 1), 5)}).size() == 2);
}

TEST_CASE("beam_unite: parts in any order give the same apertures, and no point of a part is lost") {
  Random random(3);
  for (uint32_t seed = 1; seed <= as_many(20, 2); ++seed) {
    CAPTURE(seed);
    std::vector<wt_aperture> parts;
    for (const uint32_t node : {3u, 9u, 60u})
      for (const Polygon& part : cut(rectangle(-1, 1, -1, 1), node == 60 ? 14 : node, seed + node))
        parts.push_back(part_of(part, node));
    const std::vector<wt_aperture> out = united(parts);
    CHECK(out.size() < parts.size());  // three lines cut some part that is whole again without one of them
    for (const uint32_t node : {3u, 9u, 60u}) {
      double area = 0;
      for (const wt_aperture& a : out) area += a.node == node ? area_of(a) : 0;
      CHECK(area == doctest::Approx(4).epsilon(1e-5));
    }
    for (uint32_t i = 0; i < 100; ++i) {
      const glm::dvec2 p(random.between(-1, 1), random.between(-1, 1));
      for (const uint32_t node : {3u, 9u, 60u})
        CHECK(std::ranges::any_of(out, [&](const wt_aperture& a) { return a.node == node && contains(a, p); }));
    }
    std::ranges::reverse(parts);
    std::ranges::rotate(parts, parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 3));
    const std::vector<wt_aperture> again = united(parts);
    REQUIRE(again.size() == out.size());
    for (size_t i = 0; i < out.size(); ++i) {
      CHECK(again[i].count == out[i].count);
      CHECK(std::equal(out[i].corners, out[i].corners + 3 * out[i].count, again[i].corners));
    }
  }
}
