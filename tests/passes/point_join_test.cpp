// SPDX-License-Identifier: Apache-2.0
// point_join: its paths against a double loop over the prefixes of both ends, written separately here; wanted links,
// depths, transmissions, the floor, parts of the prefixes.
#include "passes/point_join.hpp"

#include "passes/point_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Transmitter, receiver, steps.
using JoinedPath = std::tuple<uint32_t, uint32_t, std::vector<uint32_t>>;
using JoinedPaths = std::map<JoinedPath, std::vector<glm::dvec3>>;

struct Halves {
  std::vector<wt_solved> headers;
  std::vector<PathRow> rows;
  std::vector<bool> above;
};

// A number of a prefix that does not depend on its place in the list, which devices fill in any order.
uint32_t number_of(const wt_solved& header, const PathRow& row) {
  uint32_t out = header.transmitter;
  for (const uint32_t step : row.steps) out = 31 * out + step;
  return out % 65521;
}

// A third is hidden, and a quarter passes a surface before its tile.
Halves test_legs(const PointWorld& world, const TileTable& tiles, SolvedList& list) {
  Halves out{list.headers.read(0, list.count), download_rows(list), {}};
  std::vector<uint32_t> steps(size_t{list.count} * list.max_depth, WT_NONE);
  std::vector<double> vertices(3 * steps.size(), NAN);
  for (size_t i = 0; i < out.rows.size(); ++i) {
    PathRow& row = out.rows[i];
    const glm::dvec3 from = world.end(out.headers[i].transmitter).position_m;
    const glm::dvec3 before = row.points.size() > 1 ? row.points[row.points.size() - 2] : from;
    const Quad& quad = world.quads[tiles.surface(tiles.at(row.steps.back() & ~WT_STEP_KIND))];
    out.above.push_back(glm::dot(normal_of(quad), before - quad.corner) > 0);
    const uint32_t number = number_of(out.headers[i], row);
    row.blocked = number % 3 == 0;
    if (number % 4 == 0) {
      row.steps.insert(row.steps.end() - 1, WT_STEP_TRANSMISSION | 3u);
      row.points.insert(row.points.end() - 1, 0.5 * (before + row.points.back()));
    }
    out.headers[i].blocked = row.blocked;
    out.headers[i].depth = static_cast<uint32_t>(row.steps.size());
    out.headers[i].quarters = 1u << number % 3 | 8u;
    for (size_t k = 0; k < row.steps.size(); ++k) {
      steps[i * list.max_depth + k] = row.steps[k];
      for (int axis = 0; axis < 3; ++axis)
        vertices[3 * (i * list.max_depth + k) + static_cast<size_t>(axis)] = row.points[k][axis];
    }
  }
  list.headers.write(out.headers);
  list.sequences.write(steps);
  list.vertices.write(vertices);
  return out;
}

double length_of(const glm::dvec3& from, const PathRow& row) {
  double length_m = glm::distance(from, row.points[0]);
  for (size_t k = 1; k < row.points.size(); ++k) length_m += glm::distance(row.points[k - 1], row.points[k]);
  return length_m;
}

struct Expected {
  JoinedPaths paths;
  uint64_t weak = 0;
};

uint32_t passed(const PathRow& row) {
  return static_cast<uint32_t>(
      std::ranges::count_if(row.steps, [](uint32_t step) { return (step & WT_STEP_KIND) == WT_STEP_TRANSMISSION; }));
}

Expected every_pair(const PointWorld& world, const Halves& halves, const JoinedPoints& limits) {
  Expected out;
  for (size_t i = 0; i < halves.rows.size(); ++i)
    for (size_t j = 0; j < halves.rows.size(); ++j) {
      const PathRow &a = halves.rows[i], &b = halves.rows[j];
      const uint32_t tx = halves.headers[i].transmitter, other = halves.headers[j].transmitter;
      const uint32_t rx = world.receiver_of(other);
      if (a.blocked || b.blocked || a.steps.back() != b.steps.back() || halves.above[i] != halves.above[j]) continue;
      if (tx >= world.transmitters.size() || rx == no_end) continue;
      if (std::ranges::find(world.links, Link{tx, rx}) == world.links.end()) continue;
      const uint32_t transmissions = passed(a) + passed(b);
      std::vector<uint32_t> steps = a.steps;
      std::vector<glm::dvec3> points = a.points;
      for (size_t k = b.steps.size() - 1; k-- > 0;) {
        steps.push_back(b.steps[k]);
        points.push_back(b.points[k]);
      }
      if (steps.size() == 1 + transmissions || steps.size() > limits.max_depth) continue;
      if (transmissions > limits.transmissions) continue;
      const double way = length_of(world.end(tx).position_m, a) * length_of(world.end(other).position_m, b);
      if (limits.floor > 0 && limits.powers[a.steps.back() & ~WT_STEP_KIND] / (way * way) < limits.floor)
        ++out.weak;
      else
        out.paths[{tx, rx, steps}] = points;
    }
  return out;
}

JoinedPaths joined_of(const SolvedList& list) {
  JoinedPaths out;
  if (list.count == 0) return out;
  const std::vector<wt_solved> headers = list.headers.read(0, list.count);
  const std::vector<PathRow> rows = download_rows(list);
  for (size_t i = 0; i < rows.size(); ++i) {
    CHECK(headers[i].blocked == 0);
    CHECK((headers[i].quarters & 8u) != 0);
    CHECK(out.emplace(JoinedPath{headers[i].transmitter, headers[i].receiver, rows[i].steps}, rows[i].points).second);
  }
  return out;
}

}  // namespace

TEST_CASE("every pair of prefixes of wanted links that see one side of one tile") {
  const PointWorld world;
  const uint32_t mirrors = as_many(2, 1), row_depth = 2 * mirrors + 4;
  PointsOnDevice device(world, mirrors, as_many(4, 8));
  PointPrefixes pass(context(), row_depth, mirrors);
  pass(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters());
  PointPrefixList& list = pass.list();
  const Halves halves = test_legs(world, device.tiles, list.rows);
  pass.make_keys(device.scene, device.buffers, device.ends, pass.list());
  Sort sort(context());
  sort(list.keys, list.order, list.rows.count, list.key_bits());
  pass.place(device.ends, pass.list());

  JoinedPoints limits{.max_depth = row_depth, .transmissions = 2, .row_depth = row_depth};
  const size_t all = every_pair(world, halves, limits).paths.size();
  CHECK(all > as_many(500, 20));
  JoinedPoints shallow = limits, opaque = limits, strong = limits;
  shallow.max_depth = 3;
  opaque.transmissions = 0;
  strong.floor = 1e-4;
  for (uint32_t tile = 0; tile < device.tiles.size(); ++tile) strong.powers.push_back(0.01 + 0.01 * (tile % 4));
  for (const JoinedPoints& limit : {limits, shallow, opaque, strong}) {
    const Expected wanted = every_pair(world, halves, limit);
    CHECK(wanted.paths.size() > as_many(4, 1));
    if (limit.floor > 0) CHECK(wanted.weak > as_many(40, 2));
    PointJoin join(context(), limit);
    CHECK(join(list, 0, list.rows.count, device.ends) == wanted.paths.size());
    CHECK(join.weak() == wanted.weak);
    CHECK(joined_of(join.list()) == wanted.paths);
    JoinedPaths parts;
    uint64_t weak = 0;
    for (uint32_t first = 0; first < list.rows.count; first += 37) {
      join(list, first, std::min(first + 37, list.rows.count), device.ends);
      parts.merge(joined_of(join.list()));
      weak += join.weak();
    }
    CHECK(parts == wanted.paths);
    CHECK(weak == wanted.weak);
  }
  PointJoin few(context(), limits);
  few.set_most(3);
  CHECK(few(list, 0, list.rows.count, device.ends) == all);
  CHECK(few.list().count == 0);
  CHECK_THROWS_WITH_AS(few.refuse(7), doctest::Contains("trace.scattering_reflections"), gpu::BufferError);
}
