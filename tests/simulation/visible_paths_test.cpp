// Which solutions are paths, in which order, and what reversal adds: against plain quadratic code and cases by hand.
// All on the host: rows as occlusion leaves them, in any order.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <random>
#include <tuple>

#include "simulation/distinct_paths.hpp"
#include "simulation/reciprocity.hpp"
#include "base/stopwatch.hpp"
#include "wavetracer/paths.hpp"

using namespace wavetracer;

namespace {

struct Path {
  uint32_t tx, rx;
  std::vector<uint32_t> surfaces;
  std::vector<glm::dvec3> points;
  bool operator==(const Path&) const = default;
};

PathGeometry geometry_of(const std::vector<Path>& paths) {
  PathGeometry out;
  for (const Path& path : paths) {
    out.tx.push_back(path.tx);
    out.rx.push_back(path.rx);
    out.surface.insert(out.surface.end(), path.surfaces.begin(), path.surfaces.end());
    out.vertex.insert(out.vertex.end(), path.points.begin(), path.points.end());
    out.first.push_back(out.surface.size());
  }
  out.interaction.assign(out.surface.size(), reflection);
  return out;
}

std::vector<Path> paths_of(const PathGeometry& geometry) {
  std::vector<Path> out;
  for (size_t i = 0; i < geometry.size(); ++i) {
    Path path{geometry.tx[i], geometry.rx[i], {}, {}};
    for (uint64_t k = geometry.first[i]; k < geometry.first[i + 1]; ++k) {
      CHECK(geometry.interaction[k] == reflection);
      path.surfaces.push_back(geometry.surface[k]);
      path.points.push_back(geometry.vertex[k]);
    }
    out.push_back(path);
  }
  return out;
}

bool same_place(const Path& a, const Path& b) {
  if (a.tx != b.tx || a.rx != b.rx || a.points.size() != b.points.size()) return false;
  for (size_t k = 0; k < a.points.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(a.points[k][axis] - b.points[k][axis]) > 1e-4) return false;
  return true;
}

std::vector<Path> by_plain_code(std::vector<Path> paths) {
  std::ranges::sort(paths, {}, [](const Path& p) { return std::tuple(p.tx, p.rx, p.surfaces.size(), p.surfaces); });
  std::vector<Path> kept;
  for (size_t i = 0; i < paths.size(); ++i)
    if (std::none_of(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const Path& earlier) { return same_place(earlier, paths[i]); }))
      kept.push_back(paths[i]);
  return kept;
}

// Sequences are distinct within a link, as those of a trie are; points lie on a grid of a third of the merge distance,
// so that many solutions touch and some only nearly.
std::vector<Path> crowded(uint32_t ends, uint32_t per_link, std::mt19937& random) {
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  std::vector<Path> paths;
  for (uint32_t tx = 0; tx < ends; ++tx)
    for (uint32_t rx = 0; rx < ends; ++rx)
      for (uint32_t i = 0; i < per_link; ++i) {
        Path path{tx, rx, {}, {}};
        for (uint32_t k = 0; k < i % 4; ++k) {
          path.surfaces.push_back(k == 0 ? i * 7919 % 1009 : below(20));
          path.points.push_back(glm::dvec3(below(12), below(9), 0) * (merge_distance_m / 3 * 1.01) +
                                glm::dvec3(1, 2, 3));
        }
        paths.push_back(path);
      }
  std::ranges::shuffle(paths, random);
  return paths;
}

Path reversed(Path path, uint32_t tx, uint32_t rx) {
  path.tx = tx;
  path.rx = rx;
  std::ranges::reverse(path.surfaces);
  std::ranges::reverse(path.points);
  return path;
}

const std::vector<uint32_t> none{no_end, no_end, no_end};

}  // namespace

TEST_CASE("no path, and one line of sight") {
  CHECK(distinct_paths({}).size() == 0);
  CHECK(distinct_paths({}).first == std::vector<uint64_t>{0});
  const std::vector<Path> sight{{4, 2, {}, {}}};
  CHECK(paths_of(distinct_paths(geometry_of(sight))) == sight);
}

TEST_CASE("order and merging are those of plain code, for any order of rows and number of threads") {
  std::mt19937 random(7);
  std::vector<Path> found = crowded(4, 60, random);
  const std::vector<Path> expected = by_plain_code(found);
  CHECK(expected.size() > 200);
  CHECK(expected.size() < found.size());
  for (const size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::ranges::shuffle(found, random);
    CHECK(paths_of(distinct_paths(geometry_of(found))) == expected);
  }
}

TEST_CASE("equal solutions merge into the lowest surfaces, to 0.1 mm and not beyond") {
  const auto on_border = [](double apart) {
    return distinct_paths(geometry_of({{0, 0, {5, 1}, {{1, 0, 0}, {0, 2, 0}}},
                                       {0, 0, {3, 9}, {{1 + apart, 0, 0}, {0, 2, apart}}},
                                       {0, 1, {5, 1}, {{1, 0, 0}, {0, 2, 0}}}}));
  };
  CHECK(on_border(0.99e-4).surface == std::vector<uint32_t>{3, 9, 5, 1});
  CHECK(on_border(1.01e-4).surface == std::vector<uint32_t>{3, 9, 5, 1, 5, 1});
  CHECK(on_border(1.01e-4).rx == std::vector<uint32_t>{0, 0, 1});
}

TEST_CASE("reversal: what one direction found, the other gets; what both found, each keeps") {
  // Ends A, B and C: transmitters 0, 1, 2 are receivers 2, 1, 0.
  const std::vector<uint32_t> other{2, 1, 0};
  const Path sight{0, 1, {}, {}}, there{0, 1, {4, 7}, {{1, 0, 0}, {2, 1, 0}}}, both{0, 1, {8}, {{0, 5, 0}}};
  const Path back{1, 2, {8}, {{0, 5, 1e-12}}}, only_back{1, 2, {3, 2, 1}, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}};
  const std::vector<Path> found{sight, both, there, back, only_back};
  const std::vector<Path> expected{
      sight, both, there, reversed(only_back, 0, 1), reversed(sight, 1, 2), back, reversed(there, 1, 2), only_back};
  const std::vector<Link> links{{0, 1}, {1, 2}};
  const PathGeometry result = with_reversed_twins(geometry_of(found), other, other, links);
  CHECK(paths_of(result) == expected);
  // Nothing more is to be had from a second time.
  CHECK(paths_of(with_reversed_twins(result, other, other, links)) == expected);
}

TEST_CASE("reversal leaves alone what is not wanted and what has no other side") {
  const std::vector<Path> found{{0, 1, {4, 7}, {{1, 0, 0}, {2, 1, 0}}}};
  const std::vector<uint32_t> other{2, 1, 0};
  const std::vector<Link> there{{0, 1}}, all{{0, 1}, {1, 2}};
  CHECK(paths_of(with_reversed_twins(geometry_of(found), other, other, there)) == found);
  CHECK(paths_of(with_reversed_twins(geometry_of(found), none, other, all)) == found);
  CHECK(paths_of(with_reversed_twins(geometry_of(found), other, none, all)) == found);
  CHECK(with_reversed_twins(geometry_of(found), other, other, all).size() == 2);
}

TEST_CASE("reversal of an end's echoes of itself: the way round is a path of the same link") {
  const std::vector<uint32_t> other{0};
  const Path corner{0, 0, {1, 2}, {{1, 0, 0}, {0, 1, 0}}}, wall{0, 0, {5}, {{3, 0, 0}}};
  const std::vector<Link> links{{0, 0}};
  CHECK(paths_of(with_reversed_twins(geometry_of({wall, corner}), other, other, links)) ==
        std::vector<Path>{wall, corner, reversed(corner, 0, 0)});
}

TEST_CASE("100,000 paths: all twins of one another after reversal") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-500, 500);
  constexpr uint32_t ends = 100;
  std::vector<Path> found;
  std::vector<Link> links;
  std::vector<uint32_t> other;
  uint32_t surface = 0;
  for (uint32_t tx = 0; tx < ends; ++tx) {
    other.push_back(ends - 1 - tx);
    for (uint32_t rx = 0; rx < ends; ++rx) {
      links.push_back({tx, rx});
      for (uint32_t i = 0; i < 10; ++i) {
        Path path{tx, rx, {}, {}};
        for (uint32_t k = 0; k < i % 5; ++k) {
          path.surfaces.push_back(surface++ * 7919 % 1'000'003);
          path.points.push_back({place(random), place(random), place(random)});
        }
        found.push_back(path);
      }
    }
  }
  std::ranges::shuffle(found, random);
  const PathGeometry geometry = geometry_of(found);
  Stopwatch watch;
  const PathGeometry distinct = distinct_paths(geometry);
  const double distinct_seconds = watch.lap();
  const PathGeometry twins = with_reversed_twins(distinct, other, other, links);
  const double twin_seconds = watch.lap();
  MESSAGE(fmt::format("{} paths sorted in {:.1f} ms, {} with reversed ones in {:.1f} ms", distinct.size(),
                      1e3 * distinct_seconds, twins.size(), 1e3 * twin_seconds));
  // Of ten paths of a link two are the line of sight, and two have one reflection: of the hundred links that are twins
  // of themselves these are their own reverse.
  CHECK(distinct.size() == 10'000 * 9);
  CHECK(twins.size() == 10'000 * 17 - 100 * 2);
  const std::vector<Path> all = paths_of(twins);
  std::vector<Path> turned;
  for (const Path& path : all) turned.push_back(reversed(path, other[path.rx], other[path.tx]));
  const auto key = [](const Path& p) { return std::tuple(p.tx, p.rx, p.surfaces.size(), p.surfaces); };
  CHECK(std::ranges::is_sorted(all, {}, key));
  std::ranges::sort(turned, {}, key);
  CHECK(turned == all);
}
