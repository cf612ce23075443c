// SPDX-License-Identifier: Apache-2.0
// tile_edges: every prefix of an edge with every tile, beside the image method and the place on the edge: none that
// solves and has a partner is left out, none is listed without a partner; and with a floor none that is strong enough.
#include "passes/tile_edges.hpp"

#include <map>
#include <set>

#include "passes/joined_wedges.hpp"
#include "passes/point_cases.hpp"
#include "passes/wedge_solve.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct WayOverEdge {
  Sequence from;
  uint32_t wedge, tile;
  auto operator<=>(const WayOverEdge&) const = default;
};
using Ways = std::set<WayOverEdge>;

constexpr uint32_t row_depth = 4, longest = 3;  // interactions of a row and of a path
constexpr BentWaves waves{0.01, 0.01};

double over_plane(const Quad& quad, const glm::dvec3& p) {
  return glm::dot(glm::normalize(glm::cross(quad.u, quad.v)), p - quad.corner);
}

PointWorld world_with_edges() {
  PointWorld out;
  out.add_vehicle();
  for (const uint32_t surface : {3u, 1u})
    for (const Wedge& wedge : reference::free_wedges(out.quads[surface], surface)) out.scene.wedges.push_back(wedge);
  return out;
}

// The prefixes of tiles and of edges of a world, sorted.
struct Seen {
  PointsOnDevice device;
  Wedges wedges;
  PointPrefixes points{context(), row_depth, 1};
  WedgePrefixes see{context()};
  WedgePrefixList* list = nullptr;
  std::vector<uint32_t> keys, point_keys;
  std::vector<wt_wedge_prefix> sorted;
  std::vector<wt_point_prefix> sorted_points;

  explicit Seen(const PointWorld& world)
      : device(world, 1, 1.7), wedges(context(), world.scene, world.models, world.instances, true) {
    wedges(device.scene);
    points(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters());
    sort(points.list());
    list = &see(device.scene, wedges.list(), device.ends, device.set.table(), device.set.quarters(), device.set.nodes(),
                device.node_count, device.set.counters());
    Sort order(context());
    order(list->keys, list->order, list->count, wedges.key_bits());
    see.place(*list);
    keys = list->keys.read(0, list->count);
    sorted = list->sorted.read(0, list->count);
    point_keys = points.list().keys.read(0, points.list().rows.count);
    sorted_points = points.list().sorted.read(0, points.list().rows.count);
  }
  void sort(PointPrefixList& of) {
    points.make_keys(device.scene, device.buffers, device.ends, of);
    Sort order(context());
    order(of.keys, of.order, of.rows.count, of.key_bits());
    points.place(device.ends, of, &wedges.list().wedges, waves);
  }
  // The strongest prefix of the tile that makes a path with a way of this end and so many interactions; 0 without one.
  double partner(const PointWorld& world, uint32_t end, size_t interactions, uint32_t tile) const {
    double out = 0;
    for (size_t j = 0; j < sorted_points.size(); ++j) {
      const wt_point_prefix& b = sorted_points[j];
      const uint32_t senders = static_cast<uint32_t>(world.transmitters.size());
      const auto wanted = [&](uint32_t x, uint32_t y) {
        return x < senders && std::ranges::count(world.links, Link{x, world.receiver_of(y)}) > 0;
      };
      if (wt_tile_of_key(point_keys[j]) == tile && interactions + b.depth <= longest &&
          (wanted(end, b.end) || wanted(b.end, end)))
        out = std::max(out, b.spread);
    }
    return out;
  }
};

JoinedPoints limits_of(double floor, const std::vector<double>& powers) {
  return {.max_depth = longest,
          .diffractions = 1,
          .bends = 1,
          .row_depth = row_depth,
          .floor = floor,
          .powers = floor > 0 ? powers : std::vector<double>{}};
}

// parts: the prefixes are taken in so many parts. spreads: if given, set to those of the ways that solve.
Ways ways_of(Seen& seen, double floor, const std::vector<double>& powers, uint32_t parts,
             std::map<WayOverEdge, double>* spreads = nullptr) {
  PointsOnDevice& device = seen.device;
  TileEdges pass(context(), device.tiles, 2, limits_of(floor, powers), waves);
  pass.place(device.scene, device.buffers, device.ends, seen.points.list());
  WedgeCandidates candidates(context(), row_depth);
  WedgeSolve solve(context(), row_depth, waves.wavelength_m);
  const std::vector<uint64_t> table = device.set.table().read();
  Counters counters(context());
  RadioEnds between;
  between.transmitters = device.ends.transmitters;
  between.receivers = pass.places();
  Ways out;
  for (uint32_t k = 0; k < parts; ++k) {
    counters.zero();
    const uint32_t count =
        pass(device.scene, *seen.list, seen.list->count * k / parts, seen.list->count * (k + 1) / parts,
             seen.wedges.list(), device.ends, seen.points.list(), candidates, counters);
    if (count == 0) continue;
    const std::vector<wt_wedge_candidate> listed = candidates.list().read(0, count);
    for (const wt_wedge_candidate& c : listed) {
      CHECK((c.back == WT_ROOT && c.wedges[1] == WT_NONE));
      CHECK(out.insert({sequence_of(table, c.node), c.wedges[0], c.receiver}).second);
    }
    if (!spreads) continue;
    PointPrefixList rows;
    rows.rows =
        solve(device.scene, seen.wedges.list(), between, device.set.table(), candidates.list(), count, counters);
    pass.make_rows(device.scene, device.buffers, rows.rows);
    CHECK(rows.rows.open == 1);
    rows.hidden = seen.points.list().hidden;
    rows.keys = context().buffer<uint32_t>(rows.rows.count, "keys");
    rows.order = context().buffer<uint32_t>(rows.rows.count, "order");
    rows.sorted = context().buffer<wt_point_prefix>(rows.rows.count, "sorted");
    seen.sort(rows);
    const auto keys = rows.keys.read(), order = rows.order.read();
    const auto sorted = rows.sorted.read();
    const auto headers = rows.rows.headers.read(0, rows.rows.count);
    const std::vector<PathRow> paths = download_rows(rows.rows);
    for (size_t i = 0; i < keys.size() && keys[i] < rows.hidden; ++i) {
      const PathRow& row = paths[order[i]];
      const uint32_t tile = row.steps.back() & ~WT_STEP_KIND, wedge = row.steps[row.steps.size() - 2] & ~WT_STEP_KIND;
      CHECK((row.steps.back() & WT_STEP_KIND) == WT_STEP_SCATTERING);
      CHECK(tile == wt_tile_of_key(keys[i]));
      CHECK(sorted[i].diffractions == 1);
      Sequence from{headers[order[i]].transmitter, {}};
      for (size_t s = 0; s + 2 < row.steps.size(); ++s) from.surfaces.push_back(row.steps[s] & ~WT_STEP_KIND);
      (*spreads)[{from, wedge, tile}] = sorted[i].spread;
    }
  }
  return out;
}

}  // namespace

TEST_CASE("tile_edges: all ways that solve and have a partner, in parts too, and few others") {
  const PointWorld world = world_with_edges();
  Seen seen(world);
  const std::vector<double> powers;
  const Ways found = ways_of(seen, 0, powers, 1);
  CHECK(ways_of(seen, 0, powers, 5) == found);
  const std::vector<uint64_t> table = seen.device.set.table().read();
  TileEdges pass(context(), seen.device.tiles, 2, limits_of(0, powers), waves);
  pass.place(seen.device.scene, seen.device.buffers, seen.device.ends, seen.points.list());
  const std::vector<double> places = pass.places().read();
  size_t pairs = 0, wanted = 0, off_vehicles = 0;
  for (size_t i = 0; i < seen.keys.size(); ++i) {
    if (seen.keys[i] == WT_NONE || seen.sorted[i].depth > 1) continue;
    const uint32_t number = wt_wedge_of(seen.keys[i]);
    if (number >= world.scene.wedges.size()) continue;  // those of the vehicle
    const Wedge& wedge = world.scene.wedges[number];
    const Sequence from = sequence_of(table, seen.sorted[i].node);
    const glm::dvec3 end = world.end(from.transmitter).position_m;
    glm::dvec3 image = end;
    for (const uint32_t s : from.surfaces) image = mirrored_by(world.scene.surfaces[s], image);
    for (uint32_t tile = 0; tile < seen.device.tiles.size(); ++tile) {
      ++pairs;
      const bool listed = found.contains({from, number, tile});
      const bool partner = seen.partner(world, from.transmitter, from.surfaces.size() + 1, tile) > 0;
      if (listed) CHECK(partner);
      if (!partner) continue;
      const glm::dvec3 at{places[4 * tile], places[4 * tile + 1], places[4 * tile + 2]};
      const std::optional<glm::dvec3> over = reference::diffraction_point(wedge, image, at);
      if (!over || !reference::in_free_sector(wedge, *over, at)) continue;
      const auto points = image_method(world.quads, end, from.surfaces, *over);
      if (!points || !reference::in_free_sector(wedge, *over, points->empty() ? end : points->back())) continue;
      if (!from.surfaces.empty() && std::abs(over_plane(world.quads[from.surfaces.back()], *over)) < 1e-6) continue;
      ++wanted;
      off_vehicles += seen.device.tiles.at(tile).part > 0;
      CAPTURE(number);
      CAPTURE(tile);
      CHECK(listed);
    }
  }
  CHECK(wanted > 200);
  CHECK(off_vehicles > 5);
  CHECK(found.size() < pairs);
}

TEST_CASE("tile_edges: with a floor no way is left out that is strong enough, and most of the others are") {
  const PointWorld world = world_with_edges();
  Seen seen(world);
  std::vector<double> powers;
  for (uint32_t tile = 0; tile < seen.device.tiles.size(); ++tile) powers.push_back(1e-6 * (1 + tile % 5));
  std::map<WayOverEdge, double> spreads;
  const Ways all = ways_of(seen, 0, {}, 1, &spreads);
  REQUIRE(spreads.size() > 200);
  size_t before = all.size() + 1;
  for (const double floor : {1e-14, 1e-12, 1e-11, 1e-10}) {
    CAPTURE(floor);
    const Ways found = ways_of(seen, floor, powers, 3);
    CHECK(std::ranges::includes(all, found));
    CHECK(found.size() < before);
    size_t strong = 0, weak = 0, kept_weak = 0;
    for (const auto& [way, spread] : spreads) {
      const double most =
          spread * powers[way.tile] * seen.partner(world, way.from.transmitter, way.from.surfaces.size() + 1, way.tile);
      const bool kept = found.contains(way);
      strong += most >= floor;
      weak += most < floor;
      kept_weak += most < floor && kept;
      if (most >= floor) CHECK(kept);
    }
    if (floor == 1e-12) CHECK((strong > 5 && weak > 5 && kept_weak < weak));
    before = found.size();
  }
}
