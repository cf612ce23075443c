// SPDX-License-Identifier: Apache-2.0
// wedge_prefixes: every (prefix, wedge) that a loop over all sequences, their next surfaces and the wedges of those
// finds, each once; images and their places about the edge in double on the host.
#include "passes/wedge_prefixes.hpp"
#include "passes/wedges.hpp"

#include <doctest/doctest.h>

#include <map>

#include "passes/wedge_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Seen = std::pair<Sequence, uint32_t>;  // prefix, wedge

struct PrefixWorld {
  Scene scene;  // static; its surfaces come first
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<Placement> placements;
  std::vector<EndState> transmitters, receivers;
  std::vector<uint32_t> listeners;
};

struct Listed {
  std::map<Seen, wt_wedge_prefix> prefixes;
  std::vector<wt_wedge> wedges;
  std::vector<wt_exact_surface> surfaces;
  std::vector<wt_surface> boxes;
};

Listed list(const PrefixWorld& world, const std::vector<Sequence>& sequences, uint32_t max_depth,
            bool free_edges = true) {
  DeviceScene scene = make_device_scene(context(), world.scene, false, 100);
  if (!world.instances.empty()) {
    PlacedScene placed = with_instances(context(), std::move(scene), world.scene, world.models, world.instances);
    placed.place(placed.scene, world.placements);
    scene = std::move(placed.scene);
  }
  Wedges wedges(context(), world.scene, world.models, world.instances, free_edges);
  wedges(scene);
  const RadioEnds ends =
      make_radio_ends(context(), world.transmitters, world.receivers, {}, single_listeners(world.listeners));
  Sequences set(context(), 1 << 15);
  enter(set, scene, sequences, max_depth);
  const uint32_t node_count = set.collect(ends.transmitter_count);
  WedgePrefixes pass(context());
  const WedgePrefixList& found =
      pass(scene, wedges.list(), ends, set.table(), set.quarters(), set.nodes(), node_count, set.counters());
  Listed out{{}, wedges.list().wedges.read(), scene.exact_surfaces.read(), scene.surfaces.read()};
  const std::vector<uint64_t> table = set.table().read();
  const std::vector<uint32_t> keys = found.keys.read(0, found.count);
  const std::vector<wt_wedge_prefix> prefixes = found.prefixes.read(0, found.count);
  for (uint32_t i = 0; i < found.count; ++i) {
    const Sequence s = sequence_of(table, prefixes[i].node);
    CHECK(prefixes[i].end == s.transmitter);
    CHECK(prefixes[i].depth == s.surfaces.size());
    CHECK(prefixes[i].last == (s.surfaces.empty() ? WT_NONE : s.surfaces.back()));
    CHECK((keys[i] & 31) == prefixes[i].depth);
    CHECK(out.prefixes.emplace(Seen{s, keys[i] >> 5}, prefixes[i]).second);  // each once
  }
  return out;
}

// Does the same on the host, from the wedges and planes of the device.
void check(const PrefixWorld& world, const std::vector<Sequence>& sequences, const Listed& found,
           bool free_edges = true) {
  std::map<Seen, glm::dvec3> expected;  // images
  size_t undecided = 0;                 // within 1e-7 rad of a face
  size_t hidden = 0;                    // that the last mirror does not show
  for (const Sequence& s : with_prefixes(sequences)) {
    Sequence prefix = s;
    prefix.surfaces.pop_back();
    const EndState& end = s.transmitter < world.transmitters.size()
                              ? world.transmitters[s.transmitter]
                              : world.receivers[world.listeners[s.transmitter - world.transmitters.size()]];
    glm::dvec3 image = end.position_m;
    for (const uint32_t number : prefix.surfaces) {
      const wt_exact_surface& surface = found.surfaces[number];
      image = mirrored_by({.normal = vector_of(surface.normal), .offset_m = surface.offset}, image);
    }
    for (uint32_t k = 0; k < found.wedges.size(); ++k) {
      const Wedge wedge = wedge_of(found.wedges[k]);
      if (wedge.surface[0] != s.surfaces.back() && wedge.surface[1] != s.surfaces.back()) continue;
      if (!free_edges && wedge.surface[0] == wedge.surface[1]) continue;
      if (prefix.surfaces.empty() && end.instance != no_instance && found.wedges[k].instance == end.instance) continue;
      if (!(wedge.length_m > 0) || !in_sector(wedge, image, -1e-7)) continue;
      const bool listed = found.prefixes.contains({prefix, k});
      if (!prefix.surfaces.empty() && !listed) {
        const uint32_t last = prefix.surfaces.back();
        hidden += !shows(found.surfaces[last], found.boxes[last], image, wedge, 0.01);
        if (!shows(found.surfaces[last], found.boxes[last], image, wedge, 1e-9)) continue;
      }
      const bool sure = in_sector(wedge, image, 1e-7);
      undecided += !sure;
      if (sure || listed) expected[{prefix, k}] = image;
    }
  }
  CHECK(found.prefixes.size() == expected.size());
  CHECK(expected.size() > 50);
  CHECK(undecided <= expected.size() / 100);
  CHECK(hidden > expected.size() / 10);
  for (const auto& [seen, image] : expected) {
    const auto match = found.prefixes.find(seen);
    REQUIRE(match != found.prefixes.end());
    const wt_wedge_prefix& prefix = match->second;
    const Wedge wedge = wedge_of(found.wedges[seen.second]);
    const double x = glm::dot(image - wedge.start, wedge.along);
    const double size = 1e-6 * (1 + glm::length(image) + glm::length(wedge.start));
    CHECK(glm::distance(glm::dvec3(prefix.image[0], prefix.image[1], prefix.image[2]), image) < size);
    CHECK(std::abs(prefix.along - x) < size);
    CHECK(std::abs(prefix.away - glm::distance(image, wedge.start + x * wedge.along)) < size);
    CHECK(std::abs(prefix.length - wedge.length_m) < size);
  }
}

// Returns some of all sequences, so that many wedges are seen by one face alone.
std::vector<Sequence> some(std::vector<Sequence> all, double share, uint32_t seed) {
  Random random(seed);
  std::erase_if(all, [&](const Sequence&) { return random() > share; });
  return all;
}

PrefixWorld standing() {
  PrefixWorld world{box_and_panels(), {}, {}, {}, {}, {}, {}};
  for (const glm::dvec3& p : {glm::dvec3{-7.1, 1.3, 2.2}, {6.3, 5.9, 1.1}}) world.transmitters.push_back({p});
  for (const glm::dvec3& p : {glm::dvec3{5.2, -4.4, 3.3}, {-1.1, 7.3, 6.2}, {0.3, -6.6, 0.7}})
    world.receivers.push_back({p});
  world.listeners = {2, 0};
  return world;
}

}  // namespace

TEST_CASE("every prefix of every end, listeners included, with every wedge that it sees: each once") {
  const PrefixWorld world = standing();
  for (const double share : {1.0, 0.1}) {
    CAPTURE(share);
    const std::vector<Sequence> sequences = some(all_sequences(4, 9, 3), share, 7);
    check(world, sequences, list(world, sequences, 3));
  }
}

TEST_CASE("without free edges their surfaces show nothing") {
  const PrefixWorld world = standing();
  const std::vector<Sequence> sequences = all_sequences(4, 9, 2);
  const Listed found = list(world, sequences, 2, false);
  check(world, sequences, found, false);
  for (const auto& entry : found.prefixes) CHECK(entry.first.second < 12);
}

TEST_CASE("the list grows until it holds all") {
  const PrefixWorld world = standing();
  const std::vector<Sequence> sequences = some(all_sequences(4, 9, 4), 0.8, 8);
  const Listed found = list(world, sequences, 4);
  CHECK(found.prefixes.size() > (1 << 14));
  check(world, sequences, found);
}

TEST_CASE("an antenna does not see the edges of its own vehicle; its reflections do, and others see them too") {
  PrefixWorld world = standing();
  const uint32_t surfaces = 9, wedges = 20;
  world.models.push_back(reference::scene_of_quads(reference::box_walls({-2, -0.9, 0.2}, {2.3, 0.9, 1.4})));
  world.models[0].wedges = reference::box_wedges({-2, -0.9, 0.2}, {2.3, 0.9, 1.4});
  world.instances = {{"a", "car", 0, surfaces, wedges}, {"b", "car", 0, surfaces + 6, wedges + 12}};
  world.placements.resize(2);
  world.placements[0].position_m = {-7, 1.2, 0.1};
  world.placements[1].position_m = {3, 8, 0.2};
  world.placements[1].rotation = glm::mat3_cast(glm::angleAxis(0.7, glm::dvec3{0, 0, 1}));
  world.transmitters[0].instance = 0;
  world.receivers[2].instance = 1;
  const std::vector<Sequence> sequences = all_sequences(4, 21, 2);
  const Listed found = list(world, sequences, 2);
  check(world, sequences, found);
  size_t own = 0, others = 0;
  for (const auto& entry : found.prefixes) {
    const auto& [prefix, wedge] = entry.first;
    if (wedge < wedges) continue;
    const uint32_t instance = wedge < wedges + 12 ? 0 : 1;
    const bool its = (prefix.transmitter == 0 && instance == 0) || (prefix.transmitter == 2 && instance == 1);
    CHECK_FALSE((its && prefix.surfaces.empty()));
    own += its;
    others += !its && prefix.surfaces.empty();
  }
  CHECK(own > 0);
  CHECK(others > 0);

  world.placements[1].present = false;
  const Listed fewer = list(world, sequences, 2);
  for (const auto& entry : fewer.prefixes) CHECK(entry.first.second < wedges + 12);
  CHECK(fewer.prefixes.size() < found.prefixes.size());
}
