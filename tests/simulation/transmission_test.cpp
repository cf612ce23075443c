// SPDX-License-Identifier: Apache-2.0
// Tests transmission from rays to paths: what split rays find, that batches, order and cache change only the time, and
// the paths of a box with a screen against brute force and the reference list.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "folders.hpp"
#include "passes/exact.hpp"
#include "passes/image_method.hpp"
#include "passes/solved_rows.hpp"
#include "passes/transmissions.hpp"
#include "radio/fields.hpp"
#include "reference/compare.hpp"
#include "scene/load.hpp"
#include "simulation/discovery.hpp"
#include "simulation/ray_cache.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

TraceConfig transmitting(uint32_t max_depth, uint32_t max_transmissions, std::optional<uint64_t> rays) {
  TraceConfig config;
  config.rays = rays;
  config.max_depth = max_depth;
  config.transmission = true;
  config.max_transmissions = max_transmissions;
  return config;
}

struct Found {
  SequenceSet sequences;
  DiscoveryCounts counts;
  bool operator==(const Found& o) const {
    return sequences == o.sequences && counts.hits == o.counts.hits &&
           counts.segments_per_depth == o.counts.segments_per_depth;
  }
};

Found discover(const Scene& scene, const TraceConfig& config, const glm::dvec3& transmitter = {0, 0, 0},
               const OrderPlan& order = {}, const std::optional<CacheConfig>& cache = {}) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 100);
  DiscoveryOptions options{.order = order};
  std::optional<RayCache> asked;
  if (cache) {
    const auto surfaces = static_cast<uint32_t>(scene.surfaces.size());
    asked.emplace(context(), uploaded, *cache,
                  CacheWorld{1, surfaces, static_cast<uint32_t>(scene.triangles.size()), surfaces, 0},
                  choose_shape(context().info(), config, order), order.launch);
    asked->begin_frame({});
    options.finder = &*asked;
  }
  Discovery discovery(context(), uploaded, config, options);
  discovery.sequences().clear();
  Found out;
  out.counts = config.rays ? discovery.find(uploaded, {.who = launchers({transmitter}), .rays = *config.rays})
                           : discovery.find_refined(uploaded, launchers({transmitter}), 0);
  const auto contained = contents(discovery.sequences(), 1);
  REQUIRE(contained.has_value());
  out.sequences = *contained;
  return out;
}

// Panels one behind the other, each turned by 45 degrees, so that what they reflect leaves sideways and meets nothing.
std::vector<Quad> slanted_screens(uint32_t count) {
  std::vector<Quad> quads;
  for (uint32_t i = 0; i < count; ++i) quads.push_back({{1.8 + i, -0.2, -0.2}, {0.4, 0.4, 0}, {0, 0, 0.4}});
  return quads;
}

SequenceSet single_surfaces(uint32_t count) {
  SequenceSet out;
  for (uint32_t i = 0; i < count; ++i) out.insert({0, {i}});
  return out;
}

// A box with a screen in it, and a loose panel.
std::vector<Quad> furnished_box() {
  std::vector<Quad> quads = reference::box_walls({-4, -3, 0}, {4, 3, 5});
  quads.push_back({{0.3, -2, 0.5}, {0.1, 3.5, 0}, {0, 0, 3}});
  quads.push_back({{-2.5, -1, 1}, {0.8, 0.3, 0.2}, {0, 0.5, 1.5}});
  return quads;
}

struct Ends {
  glm::dvec3 transmitter, receiver;
};

// Runs discovery, candidates, solve and transmissions; blocked paths are left out.
std::vector<PathRow> paths(const Scene& scene, const TraceConfig& config, const Ends& at) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 100);
  Discovery discovery(context(), uploaded, config);
  Sequences& set = discovery.sequences();
  set.clear();
  discovery.find(uploaded, {.who = launchers({at.transmitter}), .rays = *config.rays});
  const RadioEnds ends = standing_ends({at.transmitter}, {at.receiver});
  const uint32_t nodes = set.collect(1);
  Candidates candidates(context());
  const uint32_t count = candidates(uploaded, ends, set.table(), set.nodes(), nodes, set.counters());
  Solve solve(context(), config.max_depth);
  SolvedList& solved = solve(uploaded, ends, set.table(), set.quarters(), candidates.list(), count, set.counters());
  Transmissions transmissions(context(), uploaded, std::min(config.max_transmissions, config.max_depth));
  if (solved.count > 0) transmissions(uploaded, ends, solved, set.counters());
  std::vector<PathRow> rows = download_rows(solved);
  std::erase_if(rows, [](const PathRow& row) { return row.blocked; });
  return rows;
}

// Tries every sequence of reflections by the image method; returns also what the legs pass through.
std::map<std::vector<uint32_t>, std::vector<glm::dvec3>> brute_force(const std::vector<Quad>& quads,
                                                                     const TraceConfig& config, const Ends& at) {
  const Scene scene = reference::scene_of_quads(quads);
  std::map<std::vector<uint32_t>, std::vector<glm::dvec3>> out;
  std::vector<Sequence> all{{0, {}}};
  for (uint32_t depth = 1; depth <= config.max_depth; ++depth)
    for (const Sequence& s : all_sequences(1, static_cast<uint32_t>(quads.size()), depth)) all.push_back(s);
  for (const Sequence& s : all) {
    const auto points = image_method(quads, at.transmitter, s.surfaces, at.receiver);
    if (!points) continue;
    const PathRow row = with_crossings(scene, {at.transmitter, at.receiver, s.surfaces, *points});
    const size_t transmissions = row.steps.size() - s.surfaces.size();
    if (row.steps.size() <= config.max_depth && transmissions <= config.max_transmissions) out[row.steps] = row.points;
  }
  return out;
}

}  // namespace

TEST_CASE("rays split at each of 20 screens find the last one, and no further than they may") {
  const Scene scene = reference::scene_of_quads(slanted_screens(20));
  const uint64_t rays = 400000;
  for (const uint64_t batch : {uint64_t{4096}, uint64_t{0}}) {
    TraceConfig config = transmitting(20, 19, rays);
    config.batch_rays = batch;
    const Found all = discover(scene, config);
    CHECK(all.sequences == single_surfaces(20));
    CHECK(all.counts.segments_per_depth[0] == rays);
    // All rays that a screen reflects leave the scene; a part of those that it lets through meets the next one.
    for (size_t k = 1; k < 20; ++k) CHECK(all.counts.segments_per_depth[k] > 0);
  }
  CHECK(discover(scene, transmitting(20, 4, rays)).sequences == single_surfaces(5));
  CHECK(discover(scene, transmitting(4, 19, rays)).sequences == single_surfaces(4));
  CHECK(discover(scene, transmitting(20, 0, rays)).sequences == single_surfaces(1));
  // Without reflection rays are needed only for the surfaces that they see, and then continue through walls.
  TraceConfig seeing = transmitting(6, 19, rays);
  seeing.reflection = false;
  CHECK(discover(scene, seeing).sequences.empty());
  seeing.diffraction = true;
  const Found seen = discover(scene, seeing);
  CHECK(seen.sequences == single_surfaces(6));
  // Nothing is reflected: a segment is a ray, or what a hit before the last depth let through.
  uint64_t transmitted = 0;
  for (size_t k = 1; k < 6; ++k) transmitted += seen.counts.segments_per_depth[k];
  CHECK(transmitted <= seen.counts.hits);
  CHECK(seen.counts.segments_per_depth[1] < seen.counts.hits);
  seeing.transmission = false;
  CHECK(discover(scene, seeing).sequences == single_surfaces(1));
}

TEST_CASE("the sequences with transmission are those without and more") {
  const Scene scene = reference::scene_of_quads(furnished_box());
  TraceConfig config = transmitting(4, 2, 20000);
  const Found with = discover(scene, config, {2, 0.5, 2});
  config.transmission = false;
  const Found without = discover(scene, config, {2, 0.5, 2});
  CHECK(std::ranges::includes(with.sequences, without.sequences));
  CHECK(with.sequences.size() > without.sequences.size());
  CHECK(with.counts.segments_per_depth[0] == without.counts.segments_per_depth[0]);
  // In a closed box every ray hits, and every hit splits: reflected and transmitted, of which some fly out.
  CHECK(with.counts.segments_per_depth[1] == 2 * without.counts.segments_per_depth[1]);
}

TEST_CASE("batches, orders before each depth, and an exact cache change no sequence") {
  const Scene scene = reference::scene_of_quads(furnished_box());
  const glm::dvec3 at{2, 0.5, 2};
  TraceConfig config = transmitting(5, 2, 20000);
  const Found plain = discover(scene, config, at);
  for (const uint64_t batch : {256u, 1000u, 7777u}) {
    config.batch_rays = batch;
    CHECK(discover(scene, config, at) == plain);
  }
  config.batch_rays = {};
  OrderConfig order{.method = "direction-origin", .each_depth = true};
  CHECK(discover(scene, config, at, plan_order(order, {})) == plain);
  CacheConfig cache;
  cache.key = "exact";
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    cache.kind = kind;
    CHECK(discover(scene, config, at, {}, cache) == plain);
  }
  config.batch_rays = 3000;
  CHECK(discover(scene, config, at, plan_order(order, {}), cache) == plain);
}

TEST_CASE("a launch that is refined goes where it goes without transmission, and finds more") {
  const Scene scene = reference::scene_of_quads(furnished_box());
  TraceConfig config = transmitting(3, 2, {});
  config.max_rays = 300000;
  const Found with = discover(scene, config, {2, 0.5, 2});
  config.transmission = false;
  const Found without = discover(scene, config, {2, 0.5, 2});
  CHECK(with.counts.rays == without.counts.rays);
  CHECK(std::ranges::includes(with.sequences, without.sequences));
  CHECK(with.sequences.size() > without.sequences.size());
}

TEST_CASE("paths through walls: all that brute force finds, and no other") {
  const std::vector<Quad> quads = furnished_box();
  const Scene scene = reference::scene_of_quads(quads);
  for (const Ends& at : {Ends{{2, 0.5, 2}, {-1.613, -0.427, 1.719}}, Ends{{2.3, -0.7, 1.9}, {7.2, 0.6, 2.8}}})
    for (const uint32_t most : {1u, 2u, 3u}) {
      CAPTURE(most);
      const TraceConfig config = transmitting(3, most, 200000);
      const auto expected = brute_force(quads, config, at);
      const std::vector<PathRow> found = paths(scene, config, at);
      CHECK(found.size() == expected.size());
      size_t transmitted = 0;
      for (const PathRow& row : found) {
        const auto match = expected.find(row.steps);
        REQUIRE(match != expected.end());
        for (size_t k = 0; k < row.points.size(); ++k) {
          CHECK(glm::distance(row.points[k], match->second[k]) < 1e-9);
          transmitted += (row.steps[k] & WT_STEP_KIND) == WT_STEP_TRANSMISSION;
        }
      }
      CHECK(transmitted > 5);  // otherwise the test would show nothing
    }
}

TEST_CASE("a box with a screen: every path of the reference list and its field") {
  const std::filesystem::path folder = std::filesystem::path(test::source_folder()) / "tests/reference";
  const reference::Case list = reference::load_case(folder / "oracle/box_one_screen.json");
  Config config;
  config.scene.file = (folder / "scenes/box_one_screen/box_one_screen.xml").string();
  config.radio.frequency_hz = list.frequency_hz;
  const auto end = [](const char* name, const glm::dvec3& p) {
    return RadioEnd{name, {p.x, p.y, p.z}, "isotropic", "VH", {0, 0, 0}};
  };
  config.transmitters = {end("tx", list.transmitters_m[0])};
  config.receivers = {end("rx", list.receivers_m[0])};
  const Scene scene = load_scene(config);
  PathGeometry geometry;
  for (const PathRow& row : paths(scene, transmitting(list.max_depth, 2, 200000),
                                  {list.transmitters_m[0] - scene.origin_m, list.receivers_m[0] - scene.origin_m})) {
    geometry.tx.push_back(0);
    geometry.rx.push_back(0);
    for (size_t k = 0; k < row.steps.size(); ++k) {
      geometry.surface.push_back(row.steps[k] & ~WT_STEP_KIND);
      geometry.interaction.push_back(row.steps[k] & WT_STEP_KIND ? transmission : reflection);
      geometry.vertex.push_back(row.points[k]);
    }
    geometry.first.push_back(geometry.surface.size());
  }
  const Paths found = FieldModel(scene, config).compute(0, geometry);
  const reference::Comparison c = reference::compare_paths(list, found);
  MESSAGE(reference::to_string(c));
  CHECK(c.reference == 35);
  CHECK(c.recall == 1);
  CHECK(c.extra == 0);
  CHECK(c.duplicates == 0);
  CHECK(c.gain_err_db_p99 <= 0.02);
  CHECK(c.matrix_rel_err_p99 <= 0.002);
}
