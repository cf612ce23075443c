// SPDX-License-Identifier: Apache-2.0
// wedge_chains: screens in a row against closed forms, and crowds of edges against a profile of all of them, its hull
// by sorting, and bisection place by place, whose lengths are minimal.
#include "passes/wedge_chains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "passes/chain_reference.hpp"
#include "passes/solved_rows.hpp"
#include "passes/wedge_cases.hpp"
#include "radio/world_records.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Chains = std::map<std::pair<uint32_t, uint32_t>, std::vector<Chain>>;

// Quads whose first side alone diffracts.
Scene tops_of(const std::vector<Quad>& quads) {
  Scene scene = reference::scene_of_quads(quads);
  for (uint32_t i = 0; i < quads.size(); ++i) scene.wedges.push_back(reference::free_wedges(quads[i], i)[0]);
  return scene;
}

// Returns the chains of all pairs, by transmitter and receiver.
Chains chains(const Scene& scene, const Points& tx, const Points& rx, uint32_t most, bool free_edges = true) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 1000);
  std::vector<EndState> from, to;
  std::vector<Link> links;
  for (const glm::dvec3& p : tx) from.push_back({.position_m = p});
  for (const glm::dvec3& p : rx) to.push_back({.position_m = p});
  for (uint32_t t = 0; t < tx.size(); ++t)
    for (uint32_t r = 0; r < rx.size(); ++r) links.push_back({t, r});
  const RadioEnds ends = make_radio_ends(context(), from, to, links);
  const Wedges wedges(context(), scene, {}, {}, free_edges);
  const WedgeGrid grid(wedge_records(scene, {}, {}), static_cast<uint32_t>(scene.wedges.size()), 0, free_edges);
  WedgeChains pass(context(), grid, most, most, 1e-6);
  Counters counters(context());
  const SolvedList& list = pass(uploaded, wedges.list(), ends, counters);
  Chains out;
  const std::vector<PathRow> rows = download_rows(list);
  const auto headers = rows.empty() ? std::vector<wt_solved>{} : list.headers.read(0, list.count);
  for (size_t i = 0; i < rows.size(); ++i) {
    Chain chain{{}, rows[i].points};
    for (const uint32_t step : rows[i].steps) {
      CHECK((step & WT_STEP_KIND) == WT_STEP_DIFFRACTION);
      chain.wedges.push_back(step & ~WT_STEP_KIND);
    }
    std::vector<Chain>& known = out[{headers[i].transmitter, headers[i].receiver}];
    // Strings that end at the same edges have the same points.
    const auto same = std::ranges::find(known, chain.wedges, &Chain::wedges);
    if (same == known.end())
      known.push_back(chain);
    else
      CHECK(apart(same->points, chain.points) < 1e-6);
  }
  return out;
}

// The only one.
Chain chain_of(const Scene& scene, const glm::dvec3& a, const glm::dvec3& b, uint32_t most) {
  const Chains found = chains(scene, {a}, {b}, most);
  if (found.empty()) return {};
  CHECK(found.begin()->second.size() == 1);
  return found.begin()->second.front();
}

// A row of screens square to x, their tops on a parabola: the string touches all.
std::vector<Quad> row_of_screens(uint32_t count) {
  std::vector<Quad> quads;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = 10.0 * (i + 1), from_middle = x - 5.0 * (count + 1);
    quads.push_back({{x, -30, 20 - 0.004 * from_middle * from_middle}, {0, 60, 0}, {0, 0, -30}});
  }
  return quads;
}

}  // namespace

TEST_CASE("three to eight screens in a row: the string touches each, in the plane of both ends") {
  for (uint32_t count = 3; count <= WT_MOST_EDGES; count += as_many(1, WT_MOST_EDGES - 3)) {
    CAPTURE(count);
    const Scene scene = tops_of(row_of_screens(count));
    const glm::dvec3 a{0.3, -7, 1}, b{10.0 * count + 9.5, 5, 2};
    const Chain found = chain_of(scene, a, b, count);
    REQUIRE(found.wedges.size() == count);
    for (uint32_t i = 0; i < count; ++i) {
      CHECK(found.wedges[i] == i);
      CHECK(std::abs(found.points[i].x - 10.0 * (i + 1)) < 1e-9);
    }
    // Unfolded about its edges, which are parallel, the way is straight: it advances along them as it does across.
    double length = 0;
    std::vector<double> before;
    const auto across = [](const glm::dvec3& p, const glm::dvec3& q) { return std::hypot(q.x - p.x, q.z - p.z); };
    for (uint32_t i = 0; i <= count; ++i) {
      length += across(i == 0 ? a : found.points[i - 1], i == count ? b : found.points[i]);
      before.push_back(length);
    }
    for (uint32_t i = 0; i < count; ++i)
      CHECK(std::abs(found.points[i].y - (a.y + (b.y - a.y) * before[i] / length)) < 1e-10);
    CHECK(chain_of(scene, a, b, count - 1).wedges.empty());
  }
}

TEST_CASE("what the string passes over, or half planes where they do not count, is in no chain") {
  std::vector<Quad> quads = row_of_screens(5);
  quads[1].corner.z -= 3;
  const Scene scene = tops_of(quads);
  CHECK(chain_of(scene, {0, 1, 1}, {60, 2, 1}, 8).wedges == std::vector<uint32_t>{0, 2, 3, 4});
  CHECK(chain_of(scene, {0, 1, 60}, {60, 2, 50}, 8).wedges.empty());
  CHECK(chains(scene, {{0, 1, 1}}, {{60, 2, 1}}, 8, false).empty());
}

TEST_CASE("a crowd of edges: the hull over the way, and its points as bisection has them") {
  Random random(17);
  std::vector<Quad> quads;
  for (uint32_t i = 0; i < as_many(300, 100); ++i) {
    const glm::dvec3 at = random.in_cube(200);
    const double turn = random.in_cube(3).x, length = 60 + random.in_cube(40).y;
    quads.push_back({{at.x, at.y, 12 + 0.05 * at.z},
                     {length * std::cos(turn), length * std::sin(turn), 0.02 * random.in_cube(100).x},
                     {0, 0, -40}});
  }
  const Scene scene = tops_of(quads);
  Points tx, rx;
  for (uint32_t i = 0; i < as_many(12, 5); ++i) tx.push_back(random.in_cube(200)), rx.push_back(random.in_cube(200));
  for (Points* const ends : {&tx, &rx})
    for (glm::dvec3& p : *ends) p.z = 2 + 0.01 * p.z;
  const auto found = chains(scene, tx, rx, WT_MOST_EDGES), back = chains(scene, rx, tx, WT_MOST_EDGES);
  size_t with_three = 0, straight = 0;
  for (uint32_t t = 0; t < tx.size(); ++t)
    for (uint32_t r = 0; r < rx.size(); ++r) {
      CAPTURE(t);
      CAPTURE(r);
      const Chain wanted = expected(scene, tx[t], rx[r], WT_MOST_EDGES);
      const auto it = found.find({t, r});
      const std::vector<Chain> all = it == found.end() ? std::vector<Chain>{} : it->second;
      if (!wanted.wedges.empty()) CHECK(std::ranges::count(all, wanted.wedges, &Chain::wedges) == 1);
      straight += !wanted.wedges.empty();
      for (const Chain& chain : all) {
        const Points way = shortest(scene, chain.wedges, tx[t], rx[r]);
        CHECK(apart(Points(way.begin() + 1, way.end() - 1), chain.points) < 1e-6);
        CHECK(hull_over(scene, way) == chain.wedges);
        with_three += chain.wedges.size() > 2;
        // The same way back.
        std::vector<uint32_t> turned(chain.wedges.rbegin(), chain.wedges.rend());
        const auto same = std::ranges::find(back.at({r, t}), turned, &Chain::wedges);
        REQUIRE(same != back.at({r, t}).end());
        CHECK(apart(Points(same->points.rbegin(), same->points.rend()), chain.points) < 1e-6);
      }
    }
  const size_t links = tx.size() * rx.size();
  CHECK(straight > 5 * links / 18);
  CHECK(with_three > 5 * links / 36);
}

TEST_CASE("a chain whose way leaves an edge is none") {
  const glm::dvec3 a{0, 9, 15}, b{40, 9, -20};
  for (const double half : {30.0, 0.5}) {  // the edge is askew, so the way crosses it beside the plane of the ends
    std::vector<Quad> quads = row_of_screens(3);
    quads[1].corner = {20 - half, 9 - half, 20};
    quads[1].u = {2 * half, 2 * half, 0};
    quads[2].corner.z = 10;
    const Chain found = chain_of(tops_of(quads), a, b, 8);
    CHECK(found.wedges == (half > 1 ? std::vector<uint32_t>{0, 1, 2} : std::vector<uint32_t>{}));
  }
}

// Makes a house on the ground, its walls and roof closed; wedges 0 to 3 below, then those of reference::box_wedges.
Scene house_of(const glm::dvec3& low, const glm::dvec3& high) {
  Scene scene = reference::scene_of_quads(reference::box_walls(low, high));
  scene.wedges = reference::box_wedges(low, high);
  return scene;
}

TEST_CASE("where the string slips off the corner of a roof it goes around the upright edge") {
  const Scene scene = house_of({-10, -10, 0}, {10, 10, 20});
  size_t around = 0, over = 0;
  for (double y = -9.5; y < 10; y += as_many(1, 2) * 0.5) {
    CAPTURE(y);
    // The plane of the ends crosses the roof beside its corner.
    const glm::dvec3 a{-14, y - 3, 2}, b{30, y + 12, 3};
    const Chains all = chains(scene, {a}, {b}, 8);
    for (const Chain& found : all.empty() ? std::vector<Chain>{} : all.begin()->second) {
      for (size_t i = 0; i < found.wedges.size(); ++i) CHECK(on_edge(scene.wedges[found.wedges[i]], found.points[i]));
      if (found.wedges.size() == 1 && std::abs(scene.wedges[found.wedges[0]].along.z) > 0.9) {
        const auto p = reference::diffraction_point(scene.wedges[found.wedges[0]], a, b);
        REQUIRE(p);
        CHECK(glm::distance(*p, found.points[0]) < 1e-9);
        ++around;
      } else {
        const Points points = shortest(scene, found.wedges, a, b);
        CHECK(apart(Points(points.begin() + 1, points.end() - 1), found.points) < 1e-6);
        ++over;
      }
    }
  }
  CHECK(around > 3);
  CHECK(over > 10);
}

TEST_CASE("upright edges at the corners of a box") {
  const Scene scene = house_of({-1, -2, 0}, {3, 4, 5});
  const WedgeGrid grid(wedge_records(scene, {}, {}), static_cast<uint32_t>(scene.wedges.size()), 0, true);
  REQUIRE(grid.uprights.size() == 2 * scene.wedges.size());
  for (size_t i = 0; i < grid.uprights.size(); ++i) {
    const Wedge& w = scene.wedges[i / 2];
    const glm::dvec3 end = w.start + (i % 2 == 0 ? 0.0 : w.length_m) * w.along;
    REQUIRE(grid.uprights[i] < scene.wedges.size());
    const Wedge& upright = scene.wedges[grid.uprights[i]];
    CHECK(std::abs(upright.along.z) > 0.99);
    CHECK(glm::distance(glm::dvec2(upright.start), glm::dvec2(end)) < 1e-9);
  }
}

TEST_CASE("cells that an edge touches") {
  CHECK(touches_cell({-5, 0.2}, {5, 0.2}, {0, 0}, 1, 0));
  CHECK_FALSE(touches_cell({-5, 1.2}, {5, 1.2}, {0, 0}, 1, 0.1));
  CHECK(touches_cell({-5, 1.05}, {5, 1.05}, {0, 0}, 1, 0.1));
  CHECK_FALSE(touches_cell({0, 2.5}, {2.5, 0}, {0, 0}, 1, 0));
  CHECK(touches_cell({0, 1.9}, {1.9, 0}, {0, 0}, 1, 0));
  CHECK_FALSE(touches_cell({3, 0}, {5, 0}, {0, 0}, 1, 0));
}
