// SPDX-License-Identifier: Apache-2.0
// scatter: its rows against a double loop over transmitters, surfaces that they saw, tiles and receivers, written
// separately here; masked links, instances, ends on vehicles, more than one group of receivers.
#include "passes/scatter.hpp"

#include <doctest/doctest.h>

#include <map>
#include <tuple>

#include "passes/exact.hpp"
#include "passes/place.hpp"
#include "passes/triangles.hpp"
#include "passes/visible.hpp"
#include "reference/quads.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using reference::Quad;

namespace {

using ScatterRow = std::tuple<uint32_t, uint32_t, uint32_t>;  // transmitter, receiver, tile
using ScatterRows = std::map<ScatterRow, glm::dvec3>;

// Quads of the listed numbers are rough.
Scene scene_of(const std::vector<Quad>& quads, const std::vector<uint32_t>& rough) {
  Scene scene = reference::scene_of_quads(quads);
  scene.materials.push_back({.name = "rough", .scattering = 0.4});
  for (const uint32_t surface : rough) scene.surfaces[surface].material = 1;
  return scene;
}

struct World {
  Scene scene;
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<Placement> placements;
  std::vector<EndState> transmitters, receivers;
  std::vector<Link> links;
  std::vector<uint32_t> listeners;

  explicit World(const Scene& still) : scene(still) {}
  uint32_t surface_count() const {
    size_t count = scene.surfaces.size();
    for (const Instance& i : instances) count += models[i.model].surfaces.size();
    return static_cast<uint32_t>(count);
  }
  void link_all() {
    for (uint32_t t = 0; t < transmitters.size(); ++t)
      for (uint32_t r = 0; r < receivers.size(); ++r) links.push_back({t, r});
  }
};

struct Run {
  ScatterRows rows;
  size_t listed = 0, visible = 0;
};

Run scattered(const World& world, const TileTable& tiles, const std::vector<Sequence>& sequences, uint32_t max_depth) {
  DeviceScene scene = make_device_scene(context(), world.scene, false, 100);
  if (!world.instances.empty()) {
    PlacedScene placed = with_instances(context(), std::move(scene), world.scene, world.models, world.instances);
    placed.place(placed.scene, world.placements);
    scene = std::move(placed.scene);
  }
  const RadioEnds ends =
      make_radio_ends(context(), world.transmitters, world.receivers, world.links, single_listeners(world.listeners));
  Sequences set(context(), 4096);
  enter(set, scene, sequences, 3);
  const uint32_t node_count = set.collect(static_cast<uint32_t>(world.transmitters.size() + world.listeners.size()));
  Scatter scatter(context(), tiles, world.surface_count(), max_depth);
  scatter(scene, ends, set.table(), set.quarters(), set.nodes(), node_count,
          set.counters());  // it runs twice: nothing of the first run may remain
  SolvedList& list = scatter(scene, ends, set.table(), set.quarters(), set.nodes(), node_count, set.counters());
  Run run;
  run.listed = list.count;
  if (list.count == 0) return run;
  const auto headers = list.headers.read(0, list.count);
  const auto steps = list.sequences.read(0, size_t{list.count} * list.max_depth);
  const auto xyz = list.vertices.read(0, 3 * steps.size());
  const auto table = set.table().read();
  for (size_t i = 0; i < headers.size(); ++i) {
    const size_t at = i * list.max_depth;
    CHECK(headers[i].depth == 1);
    CHECK(headers[i].blocked == 0);
    CHECK((steps[at] & WT_STEP_KIND) == WT_STEP_SCATTERING);
    const uint32_t tile = steps[at] & ~WT_STEP_KIND;
    const uint64_t seen = uint64_t{WT_ROOT | headers[i].transmitter} << 32 | tiles.surface(tiles.at(tile));
    CHECK(table[headers[i].node] == seen);
    run.rows[{headers[i].transmitter, headers[i].receiver, tile}] = {xyz[3 * at], xyz[3 * at + 1], xyz[3 * at + 2]};
  }
  Occlusion occlusion(context(), scene);
  occlusion(scene, ends, list, set.counters());
  Visible visible(context(), max_depth);
  visible.clear();
  visible(list, set.counters());
  run.visible = visible.list().count;
  return run;
}

// Does the same, tile by tile.
ScatterRows expected(const World& world, const TileTable& tiles, const std::vector<Sequence>& sequences) {
  SequenceSet seen;
  for (const Sequence& s : sequences) seen.insert({s.transmitter, {s.surfaces.at(0)}});
  ScatterRows rows;
  for (uint32_t id = 0; id < tiles.size(); ++id) {
    const TilePlace place = tiles.at(id);
    const Scene& scene = place.part == 0 ? world.scene : world.models[place.part - 1];
    glm::dvec3 normal = scene.surfaces[tiles.tile(place).surface].normal, centre = tiles.tile(place).centre_m;
    if (place.instance != no_instance) {
      const Placement& at = world.placements[place.instance];
      if (!at.present) continue;
      normal = at.rotation * normal;
      centre = at.position_m + at.rotation * centre;
    }
    for (const Link& link : world.links) {
      const EndState &tx = world.transmitters[link.tx], &rx = world.receivers[link.rx];
      if (!seen.contains({link.tx, {tiles.surface(place)}})) continue;
      if (place.instance != no_instance && (tx.instance == place.instance || rx.instance == place.instance)) continue;
      const double a = glm::dot(normal, tx.position_m - centre), b = glm::dot(normal, rx.position_m - centre);
      if (a * b > 0 && std::abs(a) > 1e-4 && std::abs(b) > 1e-4) rows[{link.tx, link.rx, id}] = centre;
    }
  }
  return rows;
}

void check_equal(const Run& run, const ScatterRows& wanted) {
  CHECK(run.listed == wanted.size());
  REQUIRE(run.rows.size() == wanted.size());
  double worst = 0;
  for (const auto& [row, centre] : wanted) {
    REQUIRE(run.rows.contains(row));
    worst = std::max(worst, glm::distance(run.rows.at(row), centre));
  }
  CHECK(worst < 1e-12);
}

EndState at(const glm::dvec3& p, uint32_t instance = no_instance) { return {.position_m = p, .instance = instance}; }

const std::vector<Quad> street{{{-20, -10, 0}, {40, 0, 0}, {0, 20, 0}},  // ground
                               {{-20, -10, 0}, {40, 0, 0}, {0, 0, 12}},  // walls y = -10, y = 10
                               {{-20, 10, 0}, {40, 0, 0}, {0, 0, 12}},
                               {{-20, -10, 12}, {40, 0, 0}, {0, -8, 1}}};  // a roof

}  // namespace

TEST_CASE("every tile of every surface seen directly, for wanted receivers on the same side of it") {
  World world(scene_of(street, {0, 2, 3}));
  world.transmitters = {at({-8, 1, 2}), at({3, -2, 5}), at({0, -14, 15})};
  Random random(1);
  for (int i = 0; i < 37; ++i)
    world.receivers.push_back(at({random.between(-18, 18), random.between(-9, 16), random.between(-1, 14)}));
  world.receivers[4].position_m.z = 0;      // on the ground
  world.receivers[20].position_m.z = 5e-5;  // as good as on it
  world.receivers[36].position_m.z = 2e-4;  // above it
  for (uint32_t t = 0; t < 3; ++t)
    for (uint32_t r = 0; r < 37; ++r)
      if ((t + 3 * r) % 4 != 0 && !(t == 1 && r < 16)) world.links.push_back({t, r});  // a group without any
  // The third transmitter sees the roof and no wall; deeper nodes say nothing about what is seen.
  const std::vector<Sequence> sequences{{0, {0}}, {0, {1, 2}}, {0, {2, 0, 2}}, {1, {0, 1}},
                                        {1, {2}}, {2, {3}},    {2, {1, 3}}};
  const TileTable tiles(world.scene, world.models, world.instances, as_many(8, 14));
  const ScatterRows wanted = expected(world, tiles, sequences);
  CHECK(wanted.size() > 1000);
  for (const uint32_t max_depth : {1u, 3u}) check_equal(scattered(world, tiles, sequences, max_depth), wanted);
}

TEST_CASE("instances: placed tiles, absent ones, and the vehicles that carry the ends") {
  World world(scene_of(street, {1}));
  const std::vector<Quad> box = reference::box_walls({-2, -1, 0}, {2, 1, 1.5});
  world.models = {scene_of(box, {0, 1, 2, 3, 5}), scene_of(box, {})};
  uint32_t first = 4;
  for (const uint32_t model : {0u, 1u, 0u, 0u}) {
    world.instances.push_back({"v", "car", model, first});
    first += 6;
    const double turn = 0.7 * first;
    Placement placement;
    placement.position_m = {-14.0 + first, 0.2 * first - 3, 0};
    placement.rotation = {{std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}, {0, 0, 1}};
    world.placements.push_back(placement);
  }
  world.placements[3].present = false;
  world.transmitters = {at({-8, 1, 4}), at(world.placements[0].position_m + glm::dvec3{0, 0, 2}, 0)};
  Random random(2);
  for (int i = 0; i < 18; ++i)
    world.receivers.push_back(
        at({random.between(-18, 18), random.between(-9, 9), random.between(1, 5)}, i % 5 == 0 ? 2 : no_instance));
  world.link_all();
  std::vector<Sequence> sequences;
  for (uint32_t t = 0; t < 2; ++t)
    for (uint32_t s = 0; s < world.surface_count(); ++s) sequences.push_back({t, {s}});
  const TileTable tiles(world.scene, world.models, world.instances, 6);
  const ScatterRows wanted = expected(world, tiles, sequences);
  size_t moving = 0;
  for (const auto& [row, centre] : wanted) moving += std::get<2>(row) >= tiles.tiles(0).size();
  CHECK(moving > 200);
  check_equal(scattered(world, tiles, sequences, 2), wanted);
}

TEST_CASE("what listeners see scatters nothing of theirs: they are no transmitters") {
  World world(scene_of(street, {0}));
  world.transmitters = {at({-8, 1, 2})};
  world.receivers = {at({5, 1, 2}), at({6, 2, 3})};
  world.listeners = {0, 1};
  world.link_all();
  const TileTable tiles(world.scene, world.models, world.instances, 5);
  CHECK(scattered(world, tiles, {{1, {0}}, {2, {0}}}, 1).listed == 0);
  CHECK(scattered(world, tiles, {{0, {0}}, {1, {0}}}, 1).listed == 2 * tiles.size());
}

TEST_CASE("occlusion: a tile's own surface hides nothing, one in between does") {
  World world(scene_of({street[0]}, {0}));
  world.transmitters = {at({-8, 1, 2})};
  world.receivers = {at({5, 1, 2})};
  world.link_all();
  const TileTable tiles(world.scene, world.models, world.instances, 4);
  const Run open = scattered(world, tiles, {{0, {0}}}, 2);
  CHECK(open.listed == tiles.size());
  CHECK(open.visible == tiles.size());
  // A wall across the street at x = 0: one leg of every path crosses it.
  world.scene = scene_of({street[0], {{0, -10, 0}, {0, 20, 0}, {0, 0, 12}}}, {0});
  const TileTable same(world.scene, world.models, world.instances, 4);
  const Run walled = scattered(world, same, {{0, {0}}}, 2);
  CHECK(walled.listed == tiles.size());
  CHECK(walled.visible == 0);
}

TEST_CASE("occlusion: of many links over the same tiles, each has what it has alone") {
  // Boxes on the ground hide some first legs and some last ones; links share transmitters, receivers and tiles.
  std::vector<Quad> quads{street[0]};
  for (const double x : {-9.0, 0.0, 8.0})
    for (const Quad& q : reference::box_walls({x, -4, 0.01}, {x + 2, 3, 5})) quads.push_back(q);
  World world(scene_of(quads, {0}));
  for (int i = 0; i < 3; ++i) world.transmitters.push_back(at({-12.0 + 8 * i, 1.3 - i, 2}));
  for (uint32_t i = 0; i < as_many(21, 17); ++i)
    world.receivers.push_back(at({-14.3 + 1.4 * i, i % 2 ? 5.1 : -6.2, 1.5 + 0.1 * i}));
  world.link_all();
  const TileTable tiles(world.scene, world.models, world.instances, as_many(2, 5));
  const std::vector<Sequence> seen{{0, {0}}, {1, {0}}, {2, {0}}};
  const Run together = scattered(world, tiles, seen, 2);
  size_t alone = 0;
  World one = world;
  for (const EndState& tx : world.transmitters)
    for (const EndState& rx : world.receivers) {
      one.transmitters = {tx};
      one.receivers = {rx};
      one.links = {{0, 0}};
      alone += scattered(one, tiles, {{0, {0}}}, 2).visible;
    }
  CHECK(together.listed == world.links.size() * tiles.size());
  CHECK(together.visible == alone);
  CHECK(alone > together.listed / 10);
  CHECK(alone < together.listed * 9 / 10);
}

TEST_CASE("nothing rough, nothing seen: no rows") {
  World world(scene_of(street, {}));
  world.transmitters = {at({-8, 1, 2})};
  world.receivers = {at({5, 1, 2})};
  world.link_all();
  CHECK(scattered(world, TileTable(world.scene, {}, {}, 1), {{0, {0}}}, 1).listed == 0);
  world.scene = scene_of(street, {0});
  CHECK(scattered(world, TileTable(world.scene, {}, {}, 1), {}, 1).listed == 0);
}

TEST_CASE("more rows than a buffer holds: an error that names trace.tile_m, before anything is allocated") {
  World world(scene_of({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}}, {0}));
  world.transmitters = {at({1, 1, 2})};
  world.receivers.assign(2048, at({5, 5, 2}));
  world.link_all();
  const TileTable tiles(world.scene, world.models, world.instances, 0.0626);
  REQUIRE(tiles.size() == 65536);
  const uint64_t rows = 2048 * uint64_t{tiles.size()};
  if (rows * 24 * WT_MAX_DEPTH <= context().info().max_buffer) return;  // more than 100 GB
  CHECK_THROWS_WITH_AS(scattered(world, tiles, {{0, {0}}}, WT_MAX_DEPTH), doctest::Contains("raise trace.tile_m"),
                       RuntimeError);
}
