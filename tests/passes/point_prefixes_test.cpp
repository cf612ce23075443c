// SPDX-License-Identifier: Apache-2.0
// point_prefixes: its rows against the image method on parallelograms for every end, every chain and every tile; the
// order of the keys, and what the join gets of each row.
#include "passes/point_prefixes.hpp"

#include "passes/point_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

double over_quad(const Quad& quad, const glm::dvec3& p) { return glm::dot(normal_of(quad), p - quad.corner); }

glm::dvec3 centre_of(const PointWorld& world, const TileTable& tiles, uint32_t tile) {
  const TilePlace place = tiles.at(tile);
  const glm::dvec3 p = tiles.tile(place).centre_m;
  if (place.instance == no_instance) return p;
  return world.placements[place.instance].position_m + world.placements[place.instance].rotation * p;
}

PointPrefixMap every_prefix(const PointWorld& world, const TileTable& tiles, uint32_t mirrors) {
  PointPrefixMap out;
  std::vector<Sequence> chains;
  for (uint32_t depth = 0; depth <= mirrors; ++depth)
    for (const Sequence& s : all_sequences(world.end_count(), static_cast<uint32_t>(world.quads.size()), depth))
      chains.push_back(s);
  for (uint32_t tile = 0; tile < tiles.size(); ++tile) {
    const uint32_t surface = tiles.surface(tiles.at(tile));
    const glm::dvec3 centre = centre_of(world, tiles, tile);
    for (const auto& [end, chain] : chains) {
      if (!chain.empty() && chain.back() == surface) continue;
      if (world.carries(chain.empty() ? surface : chain[0], end)) continue;
      auto points = image_method(world.quads, world.end(end).position_m, chain, centre);
      if (!points) continue;
      const glm::dvec3 before = points->empty() ? world.end(end).position_m : points->back();
      if (std::abs(over_quad(world.quads[surface], before)) <= 1e-4) continue;
      points->push_back(centre);
      out[{end, chain, tile}] = *points;
    }
  }
  return out;
}

void check_same(const PointPrefixMap& found, const PointPrefixMap& wanted) {
  REQUIRE(found.size() == wanted.size());
  double worst = 0;
  for (const auto& [key, points] : wanted) {
    REQUIRE(found.contains(key));
    for (size_t k = 0; k < points.size(); ++k) worst = std::max(worst, glm::distance(points[k], found.at(key)[k]));
  }
  CHECK(worst < 1e-12);
}

}  // namespace

TEST_CASE("every tile that an end sees by a chain of mirrors, and no other") {
  const auto mirrors = as_many(2, 1);
  PointWorld still, moving;
  moving.add_vehicle();
  for (const PointWorld& world : {still, moving}) {
    PointsOnDevice device(world, mirrors, as_many(1, 5));
    const PointPrefixMap wanted = every_prefix(world, device.tiles, mirrors);
    CHECK(wanted.size() > as_many(300, 20));
    PointPrefixes pass(context(), mirrors + 1, mirrors);
    const uint32_t all = device.tiles.size();
    // It runs twice: nothing of the first run may remain.
    pass(device.scene, device.buffers, device.ends, device.found(), 0, all, device.set.counters());
    CHECK(pass(device.scene, device.buffers, device.ends, device.found(), 0, all, device.set.counters()) ==
          wanted.size());
    check_same(prefixes_of(pass.list().rows), wanted);
    // The tiles in two parts, and chains that are shorter than those of the trie.
    PointPrefixMap parts, shorter = wanted;
    for (const auto& [first, end] : {std::pair{0u, all / 3}, std::pair{all / 3, all}}) {
      pass(device.scene, device.buffers, device.ends, device.found(), first, end, device.set.counters());
      parts.merge(prefixes_of(pass.list().rows));
    }
    check_same(parts, wanted);
    std::erase_if(shorter, [](const auto& prefix) { return !std::get<1>(prefix.first).empty(); });
    PointPrefixes straight(context(), 1, 0);
    straight(device.scene, device.buffers, device.ends, device.found(), 0, all, device.set.counters());
    check_same(prefixes_of(straight.list().rows), shorter);
  }
}

TEST_CASE("keys bring the prefixes of one side of one tile together; hidden ones come last") {
  const PointWorld world;
  PointsOnDevice device(world, 1, as_many(2, 5));
  PointPrefixes pass(context(), 2, 1);
  const uint32_t count =
      pass(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters());
  PointPrefixList& list = pass.list();
  std::vector<wt_solved> headers = list.rows.headers.read(0, count);
  size_t hidden = 0;
  for (uint32_t i = 0; i < count; i += 5, ++hidden) headers[i].blocked = 1;
  list.rows.headers.write(headers, 0, Stage::transfer);
  pass.make_keys(device.scene, device.buffers, device.ends, pass.list());
  Sort sort(context());
  sort(list.keys, list.order, count, list.key_bits());
  pass.place(device.ends, pass.list());
  const auto keys = list.keys.read(0, count), order = list.order.read(0, count);
  const std::vector<PathRow> rows = download_rows(list.rows);
  const auto sorted = list.sorted.read(0, count);
  CHECK(std::ranges::is_sorted(keys));
  CHECK(std::ranges::count(keys, list.hidden) == static_cast<std::ptrdiff_t>(hidden));
  size_t above = 0;
  for (uint32_t i = 0; i < count && keys[i] < list.hidden; ++i) {
    const PathRow& row = rows[order[i]];
    const uint32_t end = headers[order[i]].transmitter, tile = row.steps.back() & ~WT_STEP_KIND;
    const glm::dvec3 from = world.end(end).position_m;
    const glm::dvec3 before = row.points.size() > 1 ? row.points[row.points.size() - 2] : from;
    const bool side = over_quad(world.quads[device.tiles.surface(device.tiles.at(tile))], before) > 0;
    above += side;
    CHECK(!row.blocked);
    CHECK(keys[i] == 2 * tile + side);
    double length_m = glm::distance(from, row.points[0]);
    for (size_t k = 1; k < row.points.size(); ++k) length_m += glm::distance(row.points[k - 1], row.points[k]);
    CHECK(std::abs(sorted[i].spread * length_m * length_m - 1) < 1e-12);
    CHECK(sorted[i].row == order[i]);
    CHECK(sorted[i].end == end);
    CHECK(sorted[i].depth == row.steps.size());
    CHECK(sorted[i].transmissions == 0);
    CHECK(sorted[i].quarters == headers[order[i]].quarters);
  }
  CHECK(above > 0);
  CHECK(above < count - hidden);
}

TEST_CASE("nothing found, no links, no tiles: no prefixes") {
  const PointWorld world;
  PointsOnDevice device(world, 0, 5);
  PointPrefixes pass(context(), 1, 0);
  const FoundSequences none{device.set.table(), device.set.quarters(), device.set.nodes(), 0};
  CHECK(pass(device.scene, device.buffers, device.ends, none, 0, device.tiles.size(), device.set.counters()) == 0);
  CHECK(pass(device.scene, device.buffers, device.ends, device.found(), 3, 3, device.set.counters()) == 0);
  pass.set_most(1);
  CHECK(pass(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters()) >
        1);
  CHECK_THROWS_WITH_AS(pass.refuse(7), doctest::Contains("trace.scattering_reflections"), gpu::BufferError);
}
