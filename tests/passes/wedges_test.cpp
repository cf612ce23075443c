// SPDX-License-Identifier: Apache-2.0
// wedges: where instances have them, their numbers, and which surfaces they bound.
// Poses are random rotations; expected places are computed with quaternions.
#include "passes/wedges.hpp"

#include <doctest/doctest.h>

#include "passes/wedge_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A box model of 12 wedges and a panel model of 4, three instances of the former and two of the latter, one absent.
struct Fleet {
  Scene still = box_and_panels();
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<Placement> placements;
  std::vector<glm::dquat> turns;

  Fleet() {
    const Quad panel{{-0.4, -1, 0.2}, {0.3, 2.1, 0}, {0.1, 0, 1.4}};
    models.push_back(reference::scene_of_quads(reference::box_walls({-2, -0.9, 0.2}, {2.3, 0.9, 1.4})));
    models[0].wedges = reference::box_wedges({-2, -0.9, 0.2}, {2.3, 0.9, 1.4});
    for (Wedge& w : models[0].wedges) w.plane = {w.surface[0] / 2, w.surface[1] / 2};  // changed wedges
    models.push_back(reference::scene_of_quads({panel}));
    models[1].wedges = reference::free_wedges(panel, 0);
    Random random(3);
    auto surface = static_cast<uint32_t>(still.surfaces.size()), wedge = static_cast<uint32_t>(still.wedges.size());
    for (const uint32_t model : {0u, 1u, 0u, 1u, 0u}) {
      instances.push_back({"v", "car", model, surface, wedge});
      surface += static_cast<uint32_t>(models[model].surfaces.size());
      wedge += static_cast<uint32_t>(models[model].wedges.size());
      turns.push_back(glm::angleAxis(random.between(0, 6.28), random.direction()));
      Placement placement;
      placement.position_m = random.in_cube(20);
      placement.rotation = glm::mat3_cast(turns.back());
      placement.present = instances.size() != 3;
      placements.push_back(placement);
    }
  }
};

double distance(const double* v, const glm::dvec3& expected) { return glm::distance(vector_of(v), expected); }

}  // namespace

TEST_CASE("wedges of instances are where their poses put them, frame after frame; those of absent ones are nowhere") {
  Fleet fleet;
  auto [scene, place] = with_instances(context(), make_device_scene(context(), fleet.still, false, 60), fleet.still,
                                       fleet.models, fleet.instances);
  Wedges wedges(context(), fleet.still, fleet.models, fleet.instances, true);
  Random random(5);
  for (int frame = 0; frame < 3; ++frame) {
    place(scene, fleet.placements);
    wedges(scene);
    const std::vector<wt_wedge> records = wedges.list().wedges.read();
    REQUIRE(records.size() == 20 + 3 * 12 + 2 * 4);
    for (uint32_t k = 0; k < 20; ++k) {
      CHECK(distance(records[k].start, fleet.still.wedges[k].start) == 0);
      CHECK(distance(records[k].along, fleet.still.wedges[k].along) == 0);
      CHECK(records[k].length == fleet.still.wedges[k].length_m);
      CHECK(records[k].instance == WT_NONE);
    }
    for (uint32_t i = 0; i < fleet.instances.size(); ++i) {
      const Instance& instance = fleet.instances[i];
      const std::vector<Wedge>& model = fleet.models[instance.model].wedges;
      for (uint32_t k = 0; k < model.size(); ++k) {
        const wt_wedge& record = records[instance.first_wedge + k];
        CHECK(record.instance == i);
        CHECK(record.exterior == model[k].exterior_rad);
        for (size_t face = 0; face < 2; ++face) {
          CHECK(record.surfaces[face] == instance.first_surface + model[k].surface[face]);
          CHECK(record.planes[face] == instance.first_surface + model[k].plane[face]);
        }
        if (!fleet.placements[i].present) {
          CHECK(std::isnan(record.length));
          continue;
        }
        CHECK(record.length == model[k].length_m);
        CHECK(distance(record.start, fleet.placements[i].position_m + fleet.turns[i] * model[k].start) < 1e-13);
        CHECK(distance(record.along, fleet.turns[i] * model[k].along) < 1e-14);
        CHECK(distance(record.face, fleet.turns[i] * model[k].face) < 1e-14);
        CHECK(distance(record.normal, fleet.turns[i] * model[k].normal) < 1e-14);
      }
    }
    for (size_t i = 0; i < fleet.placements.size(); ++i) {
      fleet.turns[i] = glm::angleAxis(random.between(0, 6.28), random.direction());
      fleet.placements[i].rotation = glm::mat3_cast(fleet.turns[i]);
      fleet.placements[i].position_m = random.in_cube(20);
      fleet.placements[i].present = !fleet.placements[i].present;
    }
  }
}

TEST_CASE("each surface lists the wedges that it bounds, each once; without free edges those of two faces alone") {
  const Fleet fleet;
  for (const bool free_edges : {true, false}) {
    CAPTURE(free_edges);
    const Wedges wedges(context(), fleet.still, fleet.models, fleet.instances, free_edges);
    const std::vector<wt_wedge> records = wedges.list().wedges.read();
    const std::vector<uint32_t> first = wedges.list().first.read(), listed = wedges.list().of_surfaces.read();
    REQUIRE(first.size() == 9 + 3 * 6 + 2 * 1 + 1);
    std::set<std::pair<uint32_t, uint32_t>> expected, found;
    for (uint32_t k = 0; k < records.size(); ++k)
      for (const uint32_t surface : records[k].surfaces)
        if (free_edges || records[k].surfaces[0] != records[k].surfaces[1]) expected.emplace(surface, k);
    for (uint32_t surface = 0; surface + 1 < first.size(); ++surface)
      for (uint32_t at = first[surface]; at < first[surface + 1]; ++at)
        CHECK(found.emplace(surface, listed[at]).second);
    CHECK(found == expected);
    CHECK(wedges.diffracting() == (free_edges ? 20 + 36 + 8 : 12 + 36));
    CHECK((uint64_t{1} << wedges.key_bits()) > wt_wedge_key(static_cast<uint32_t>(records.size() - 1), 31u));
  }
}

TEST_CASE("a world without wedges, and one without instances") {
  const Scene bare = reference::scene_of_quads({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  const DeviceScene scene = make_device_scene(context(), bare, false, 10);
  Wedges none(context(), bare, {}, {}, true);
  none(scene);
  CHECK(none.diffracting() == 0);
  CHECK(none.list().first.read() == std::vector<uint32_t>{0, 0});
  const Scene still = box_and_panels();
  Wedges fixed(context(), still, {}, {}, true);
  fixed(scene);
  CHECK(fixed.diffracting() == 20);
}
