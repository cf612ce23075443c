// SPDX-License-Identifier: Apache-2.0
// visible: the rows that occlusion left, row for row, in any order; a list that must grow; an empty list.
#include "passes/visible.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using ListedRow =
    std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, uint32_t, std::vector<uint32_t>, std::vector<double>>;

// Rows of a list but the obstructed, sorted.
std::vector<ListedRow> rows_of(const SolvedList& list) {
  std::vector<ListedRow> rows;
  if (list.count == 0) return rows;
  const auto headers = list.headers.read(0, list.count);
  const auto surfaces = list.sequences.read(0, size_t{list.count} * list.max_depth);
  const auto points = list.vertices.read(0, 3 * surfaces.size());
  for (size_t i = 0; i < headers.size(); ++i) {
    if (headers[i].blocked) continue;
    const auto at = static_cast<std::ptrdiff_t>(i * list.max_depth);
    const auto depth = static_cast<std::ptrdiff_t>(headers[i].depth);
    rows.emplace_back(headers[i].transmitter, headers[i].receiver, headers[i].depth, headers[i].node,
                      headers[i].quarters, std::vector(surfaces.begin() + at, surfaces.begin() + at + depth),
                      std::vector(points.begin() + 3 * at, points.begin() + 3 * (at + depth)));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

SolvedList made_up(uint32_t count, uint32_t max_depth, double blocked_share) {
  Random random(count);
  SolvedList list;
  list.max_depth = max_depth;
  list.count = count;
  list.reserve(context(), std::max(count, 1u));
  std::vector<wt_solved> headers(count);
  std::vector<uint32_t> surfaces(size_t{count} * max_depth);
  std::vector<double> points(3 * surfaces.size());
  for (uint32_t i = 0; i < count; ++i)
    headers[i] = {random.below(9), random.below(9), random.below(max_depth + 1), random() < blocked_share, i,
                  random.below(16)};
  for (uint32_t& surface : surfaces) surface = random.below(1000);
  for (double& x : points) x = random.between(-100, 100);
  if (count > 0) {
    list.headers.write(headers);
    list.sequences.write(surfaces);
    list.vertices.write(points);
  }
  return list;
}

}  // namespace

TEST_CASE("visible keeps every row that is not obstructed, and no other") {
  Visible visible(context(), 5);
  Counters counters(context());
  for (const uint32_t count : {0u, 1u, 100u, 9000u})
    for (const double blocked : {0.0, 0.7, 1.0}) {
      const SolvedList solved = made_up(count, 5, blocked);
      counters.zero();
      visible.clear();
      visible(solved, counters);
      const SolvedList& kept = visible.list();
      const std::vector<ListedRow> wanted = rows_of(solved);
      CHECK(kept.count == wanted.size());
      CHECK((rows_of(kept) == wanted));
    }
}

TEST_CASE("visible appends list after list, and keeps what it has where it must grow") {
  Visible visible(context(), 5);
  Counters counters(context());
  std::vector<ListedRow> wanted;
  for (const uint32_t count : {30u, 0u, 9001u, 500u}) {
    const SolvedList solved = made_up(count, 5, 0.3);
    visible(solved, counters);
    const std::vector<ListedRow> more = rows_of(solved);
    wanted.insert(wanted.end(), more.begin(), more.end());
  }
  std::sort(wanted.begin(), wanted.end());
  CHECK((rows_of(visible.list()) == wanted));
  visible.clear();
  CHECK(visible.list().count == 0);
}
