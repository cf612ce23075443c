// SPDX-License-Identifier: Apache-2.0
// distinct: which solutions are paths, their order, the paths that reversal adds; checked by plain quadratic code.
#include "passes/distinct.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <tuple>

#include "passes/on_device.hpp"
#include "passes/scan.hpp"
#include "passes/sort.hpp"
#include "wavetracer/device/path_rows.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t max_depth = 4;

struct Path {
  uint32_t tx, rx;
  std::vector<uint32_t> surfaces;
  std::vector<glm::dvec3> points;
  uint32_t quarters = 1;
  bool operator==(const Path&) const = default;
};

// Ends, and which of them are one end: both have number n if `other` says so.
struct Ends {
  std::vector<glm::dvec3> tx, rx;
  std::vector<uint32_t> receiver_of, transmitter_of;  // WT_NONE: of no end
};

Ends apart(size_t transmitters, size_t receivers) {
  Ends ends{{}, {}, std::vector<uint32_t>(transmitters, WT_NONE), std::vector<uint32_t>(receivers, WT_NONE)};
  for (size_t i = 0; i < transmitters; ++i) ends.tx.emplace_back(-20.0, 7.0 * static_cast<double>(i), 3);
  for (size_t i = 0; i < receivers; ++i) ends.rx.emplace_back(30.0, 5.0 * static_cast<double>(i) + 1, 2);
  return ends;
}

// Transmitter t is at the place of receiver other[t].
Ends radios(const std::vector<uint32_t>& other) {
  Ends ends = apart(other.size(), other.size());
  ends.receiver_of = other;
  for (uint32_t t = 0; t < other.size(); ++t) {
    ends.transmitter_of[other[t]] = t;
    ends.rx[other[t]] = ends.tx[t];
  }
  return ends;
}

double length_of(const Ends& ends, const Path& path) {
  double length = 0;
  glm::dvec3 from = ends.tx[path.tx];
  for (const glm::dvec3& point : path.points) {
    length += glm::length(point - from);
    from = point;
  }
  return length + glm::length(ends.rx[path.rx] - from);
}

Path reversed(Path path, uint32_t tx, uint32_t rx) {
  path.tx = tx;
  path.rx = rx;
  std::ranges::reverse(path.surfaces);
  std::ranges::reverse(path.points);
  return path;
}

bool same_place(const Path& a, const Path& b) {
  for (size_t k = 0; k < a.points.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(a.points[k][axis] - b.points[k][axis]) > WT_MERGE_M) return false;
  return true;
}

// Computes the expected result by trying every pair of rows.
std::vector<Path> by_plain_code(const Ends& ends, const std::vector<Path>& found, const std::vector<Link>& links) {
  std::vector<std::pair<Path, int>> rows;
  for (const Path& path : found) {
    rows.emplace_back(path, 0);
    const Link twin{ends.transmitter_of[path.rx], ends.receiver_of[path.tx]};
    if (twin.tx != WT_NONE && twin.rx != WT_NONE && std::ranges::find(links, twin) != links.end())
      rows.emplace_back(reversed(path, twin.tx, twin.rx), 1);
  }
  const auto rank = [](const std::pair<Path, int>& row) { return std::tuple(row.first.surfaces, row.second); };
  std::vector<Path> kept;
  for (const auto& row : rows) {
    Path path = row.first;
    bool stays = !path.points.empty() || length_of(ends, path) > WT_ON_SURFACE_M;  // no path from an end to itself
    for (const auto& other : rows) {
      const Path& p = other.first;
      if (&other == &row || p.tx != path.tx || p.rx != path.rx || p.points.size() != path.points.size()) continue;
      if (p.surfaces != path.surfaces && !same_place(p, path)) continue;
      path.quarters |= p.quarters;
      if (rank(other) != rank(row) ? rank(other) < rank(row) : &other < &row) stays = false;
    }
    if (stays) kept.push_back(path);
  }
  std::ranges::sort(kept, {}, [&](const Path& p) { return std::tuple(p.tx, p.rx, length_of(ends, p), p.surfaces); });
  return kept;
}

std::vector<EndState> states(const std::vector<glm::dvec3>& places) {
  std::vector<EndState> out(places.size());
  for (size_t i = 0; i < places.size(); ++i) out[i].position_m = places[i];
  return out;
}

SolvedList uploaded(const std::vector<Path>& paths) {
  SolvedList list;
  list.max_depth = max_depth;
  list.reserve(context(), std::max<size_t>(paths.size(), 1));
  list.count = static_cast<uint32_t>(paths.size());
  std::vector<wt_solved> headers;
  std::vector<uint32_t> steps(paths.size() * max_depth);
  std::vector<double> vertices(3 * steps.size());
  for (size_t i = 0; i < paths.size(); ++i) {
    headers.push_back(
        {paths[i].tx, paths[i].rx, static_cast<uint32_t>(paths[i].points.size()), 0, 0, paths[i].quarters});
    for (size_t k = 0; k < paths[i].points.size(); ++k) {
      steps[i * max_depth + k] = paths[i].surfaces[k] | WT_STEP_REFLECTION;
      for (int axis = 0; axis < 3; ++axis) vertices[3 * (i * max_depth + k) + axis] = paths[i].points[k][axis];
    }
  }
  if (!paths.empty()) {
    list.headers.write(headers);
    list.sequences.write(steps);
    list.vertices.write(vertices);
  }
  return list;
}

std::vector<Link> all_links(const Ends& ends) {
  std::vector<Link> links;
  for (uint32_t tx = 0; tx < ends.tx.size(); ++tx)
    for (uint32_t rx = 0; rx < ends.rx.size(); ++rx) links.push_back({tx, rx});
  return links;
}

// Surfaces that are not near any end.
DeviceScene far_surfaces() {
  DeviceScene scene;
  wt_exact_surface far{};
  far.offset = 1;
  scene.exact_surfaces = context().buffer(std::vector(2000, far), "exact surfaces");
  return scene;
}

// Returns the rows of the device; left_out: those of near ends.
std::vector<Path> by_device(const Ends& ends, const std::vector<Path>& found, const std::vector<Link>& links,
                            const DeviceScene& scene, std::map<Link, uint32_t>* left_out = nullptr) {
  Distinct distinct(context(), ends.receiver_of, ends.transmitter_of);
  Sort sort(context());
  Scan scan(context());
  const RadioEnds on_device = make_radio_ends(context(), states(ends.tx), states(ends.rx), links);
  const SolvedList visible = uploaded(found);
  Counters counters(context());
  const uint32_t places = distinct.keys(on_device, on_device.links, visible, counters);
  if (places == 0) return {};
  sort(distinct.sort_keys(), distinct.order(), places, 32);
  distinct.place(scene, nullptr, on_device, visible, counters);
  const wt_counters totals = counters.read(Stage::distinct);
  if (left_out && totals.near_rows > 0) *left_out = distinct.left_out();
  gpu::Buffer<uint32_t>& of_places = distinct.rows().counts;
  const std::vector<uint32_t> counts = of_places.read(0, places), of = distinct.rows().rows.read(0, places);
  const uint32_t sum = scan(of_places, 2 * places), rows = of_places.read_one(places), vertices = sum - rows;
  const std::vector<uint32_t> at = of_places.read(0, 2 * places);
  const std::vector<uint8_t> quarters = distinct.rows().quarters.read(0, places);
  const std::vector<double> delays = distinct.rows().delays.read(0, places);
  std::vector<Path> out;
  uint32_t seen = 0;
  for (uint32_t place = 0; place < places; ++place) {
    CHECK((of[place] == WT_NO_ROW) == (counts[place] == 0));
    if (of[place] == WT_NO_ROW) continue;
    CHECK(at[place] == out.size());
    CHECK(at[places + place] - rows == seen);
    Path path = found[of[place] / 2];
    if (of[place] % 2) path = reversed(path, ends.transmitter_of[path.rx], ends.receiver_of[path.tx]);
    path.quarters = quarters[place];
    CHECK(delays[place] == length_of(ends, path) / 299792458.0);
    seen += static_cast<uint32_t>(path.points.size());
    out.push_back(path);
  }
  CHECK((vertices == seen && totals.row_vertices == vertices));
  CHECK((rows == out.size() && totals.rows == rows));
  return out;
}

// Sequences are distinct, as those of a trie are, and none is that of another link reversed; points lie on a grid of a
// third of the merge distance, so that many solutions touch and some only nearly.
std::vector<Path> crowded(const Ends& ends, uint32_t per_link, std::mt19937& random) {
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  std::vector<Path> paths;
  for (uint32_t tx = 0; tx < ends.tx.size(); ++tx)
    for (uint32_t rx = 0; rx < ends.rx.size(); ++rx)
      for (uint32_t i = 0; i < per_link; ++i) {
        Path path{tx, rx, {}, {}, 1u << below(4)};
        for (uint32_t k = 0; k < i % 4; ++k) {
          path.surfaces.push_back(k == 0 ? 20 + static_cast<uint32_t>((tx * ends.rx.size() + rx) * per_link) + i
                                         : below(20));
          path.points.push_back(glm::dvec3(below(12), below(9), 0) * (WT_MERGE_M / 3 * 1.01) + glm::dvec3(1, 2, 3));
        }
        paths.push_back(path);
      }
  return paths;
}

}  // namespace

TEST_CASE("no path, and one line of sight") {
  const Ends ends = apart(5, 3);
  const DeviceScene scene = far_surfaces();
  CHECK(by_device(ends, {}, all_links(ends), scene).empty());
  const std::vector<Path> sight{{4, 2, {}, {}}};
  CHECK((by_device(ends, sight, all_links(ends), scene) == sight));
}

TEST_CASE("order and merging are those of plain code, for any order of rows, with twins and without") {
  std::mt19937 random(7);
  const DeviceScene scene = far_surfaces();
  for (const Ends& ends : {apart(4, 4), radios({2, 0, 1}), apart(1, 1)}) {
    const uint32_t per_link = ends.tx.size() == 1 ? as_many(400, 120) : as_many(60, 20);
    std::vector<Path> found = crowded(ends, per_link, random);
    const std::vector<Path> expected = by_plain_code(ends, found, all_links(ends));
    CHECK(expected.size() > 50);
    CHECK(expected.size() < 2 * found.size());
    for (uint32_t round = 0; round < as_many(3, 1); ++round) {
      std::ranges::shuffle(found, random);
      const std::vector<Path> rows = by_device(ends, found, all_links(ends), scene);
      CHECK((rows == expected));
    }
  }
}

TEST_CASE("equal solutions merge into the lowest surfaces, to 0.1 mm and not beyond") {
  const Ends ends = apart(1, 2);
  const DeviceScene scene = far_surfaces();
  const auto on_border = [&](double distance) {
    std::vector<std::vector<uint32_t>> surfaces;
    for (const Path& path : by_device(ends,
                                      {{0, 0, {5, 1}, {{1, 0, 0}, {0, 2, 0}}},
                                       {0, 0, {3, 9}, {{1 + distance, 0, 0}, {0, 2, distance}}},
                                       {0, 1, {5, 1}, {{1, 0, 0}, {0, 2, 0}}}},
                                      all_links(ends), scene))
      surfaces.push_back(path.surfaces);
    std::ranges::sort(surfaces);
    return surfaces;
  };
  CHECK((on_border(0.99e-4) == std::vector<std::vector<uint32_t>>{{3, 9}, {5, 1}}));
  CHECK((on_border(1.01e-4) == std::vector<std::vector<uint32_t>>{{3, 9}, {5, 1}, {5, 1}}));
}

TEST_CASE("reversal: what one direction found, the other gets; what both found, each keeps") {
  const Ends ends = radios({2, 1, 0});  // transmitters 0, 1, 2 are receivers 2, 1, 0
  const DeviceScene scene = far_surfaces();
  const Path sight{0, 1, {}, {}}, there{0, 1, {4, 7}, {{1, 0, 0}, {2, 1, 0}}}, both{0, 1, {8}, {{0, 5, 0}}};
  const Path back{1, 2, {8}, {{0, 5, 1e-12}}}, only_back{1, 2, {3, 2, 1}, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}};
  const std::vector<Path> found{only_back, back, both, there, sight};
  const std::vector<Link> links{{0, 1}, {1, 2}};
  const std::vector<Path> rows = by_device(ends, found, links, scene);
  CHECK((rows == by_plain_code(ends, found, links)));
  CHECK(rows.size() == 8);
  CHECK(std::ranges::count(rows, both) == 1);
  CHECK(std::ranges::count(rows, back) == 1);
  CHECK(std::ranges::count(rows, reversed(only_back, 0, 1)) == 1);
  // A second run adds nothing.
  CHECK((by_device(ends, rows, links, scene) == rows));
  // Links that are not computed get no reversed paths, and keep their own.
  CHECK(by_device(ends, {there}, {{0, 1}}, scene).size() == 1);
  CHECK(by_device(ends, {there}, links, scene).size() == 2);
}

TEST_CASE("reversal of an end's echoes of itself: the way round is a path of the same link") {
  const Ends ends = radios({0});
  const Path corner{0, 0, {1, 2}, {{1, 0, 0}, {0, 1, 0}}}, wall{0, 0, {5}, {{3, 0, 0}}};
  const std::vector<Path> rows = by_device(ends, {wall, corner}, {{0, 0}}, far_surfaces());
  CHECK((rows == std::vector<Path>{corner, reversed(corner, 0, 0), wall}));
}

TEST_CASE("paths of near ends are left out, and counted by link") {
  const Ends ends = apart(2, 2);
  DeviceScene scene = far_surfaces();
  wt_exact_surface floor{};
  floor.normal[2] = 1;
  floor.offset = ends.rx[1].z + 0.5e-4;
  std::vector<wt_exact_surface> surfaces(10, floor);
  scene.exact_surfaces = context().buffer(surfaces, "exact surfaces");
  std::map<Link, uint32_t> left_out;
  const std::vector<Path> rows = by_device(
      ends, {{0, 0, {}, {}}, {0, 1, {3}, {{1, 1, 2}}}, {1, 1, {}, {}}, {1, 1, {2, 5}, {{1, 1, 2}, {2, 2, 2}}}},
      all_links(ends), scene, &left_out);
  CHECK(rows.size() == 2);
  CHECK((left_out == std::map<Link, uint32_t>{{{0, 1}, 1}, {{1, 1}, 1}}));
}
