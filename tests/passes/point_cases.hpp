// SPDX-License-Identifier: Apache-2.0
// A small world with rough surfaces, one of them on a vehicle, and the prefixes of its ends that see its tiles, made by
// point_prefixes from all chains of mirrors. Legs are not tested.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "passes/image_method.hpp"
#include "passes/place.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/solved_rows.hpp"
#include "passes/sort.hpp"
#include "scene/tiles.hpp"

namespace wavetracer::test {

struct PointWorld {
  std::vector<Quad> quads{{{-6, -5, 0}, {12, 0, 0}, {0, 10, 0}},    // ground
                          {{-6, -5, 0}, {12, 0, 0}, {0, 0, 5}},     // walls y = -5, y = 5
                          {{-6, 5, 0}, {12, 0, 0}, {0.7, 0, 5.1}},  // this one leans
                          {{1.3, -1, 0.2}, {0.4, 2.5, 0}, {0, 0.2, 2.2}}};
  std::vector<uint32_t> rough{0, 2, 3};
  Scene scene;
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<Placement> placements;
  // Ends are transmitters, then listeners; transmitter 1 is receiver 2.
  std::vector<EndState> transmitters{{.position_m = {-4.1, 1.3, 2.2}}, {.position_m = {3.3, -2.9, 1.1}}};
  std::vector<EndState> receivers{
      {.position_m = {5.2, -3.4, 3.3}}, {.position_m = {-1.1, 3.3, 4.2}}, {.position_m = {3.3, -2.9, 1.1}}};
  std::vector<Link> links{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}};
  std::vector<uint32_t> listeners{1, 0};  // ends 2 and 3
  std::vector<uint32_t> receiver_of_transmitter{no_end, 2};

  PointWorld() : scene(reference::scene_of_quads(quads)) {
    scene.materials.push_back({.name = "rough", .scattering = 0.4});
    for (const uint32_t surface : rough) scene.surfaces[surface].material = 1;
  }

  // Adds a rough panel that is a vehicle, and carries receiver 0.
  void add_vehicle() {
    const Quad panel{{-1, 0, 0}, {2, 0, 0}, {0, 0.3, 1.5}};
    models = {reference::scene_of_quads({panel})};
    models[0].materials[0].scattering = 0.4;
    instances = {{"v", "car", 0, static_cast<uint32_t>(quads.size())}};
    Placement at;
    at.position_m = {-2, -1.5, 0.3};
    at.rotation = {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}};
    placements = {at};
    quads.push_back({at.position_m + at.rotation * panel.corner, at.rotation * panel.u, at.rotation * panel.v});
    receivers[0].instance = 0;
  }

  uint32_t end_count() const { return static_cast<uint32_t>(transmitters.size() + listeners.size()); }
  const EndState& end(uint32_t i) const {
    return i < transmitters.size() ? transmitters[i] : receivers[listeners[i - transmitters.size()]];
  }
  uint32_t receiver_of(uint32_t i) const {
    return i < transmitters.size() ? receiver_of_transmitter[i] : listeners[i - transmitters.size()];
  }
  bool carries(uint32_t surface, uint32_t i) const {
    return end(i).instance != no_instance && surface + instances.size() >= quads.size();
  }
};

// A world on the device, as point_prefixes needs it.
struct PointsOnDevice {
  DeviceScene scene;
  TileTable tiles;
  TileBuffers buffers;
  RadioEnds ends;
  Sequences set;
  uint32_t node_count;

  PointsOnDevice(const PointWorld& world, uint32_t mirrors, double tile_m)
      : scene(make_device_scene(context(), world.scene, false, 40)),
        tiles(world.scene, world.models, world.instances, tile_m),
        buffers(make_tile_buffers(context(), tiles, static_cast<uint32_t>(world.quads.size()))),
        ends(make_radio_ends(context(), world.transmitters, world.receivers, world.links,
                             single_listeners(world.listeners), world.receiver_of_transmitter)),
        set(context(), 1 << 12) {
    if (!world.instances.empty()) {
      PlacedScene placed = with_instances(context(), std::move(scene), world.scene, world.models, world.instances);
      placed.place(placed.scene, world.placements);
      scene = std::move(placed.scene);
    }
    enter(set, scene, all_sequences(world.end_count(), static_cast<uint32_t>(world.quads.size()), mirrors + 1),
          mirrors + 1);
    node_count = set.collect(world.end_count());
  }
  FoundSequences found() { return {set.table(), set.quarters(), set.nodes(), node_count}; }
};

// A prefix: its end, its mirrors and its tile; and the points of its reflections, then the tile's centre.
using PointPrefix = std::tuple<uint32_t, std::vector<uint32_t>, uint32_t>;
using PointPrefixMap = std::map<PointPrefix, std::vector<glm::dvec3>>;

inline PointPrefixMap prefixes_of(const SolvedList& rows) {
  PointPrefixMap out;
  if (rows.count == 0) return out;
  const std::vector<wt_solved> headers = rows.headers.read(0, rows.count);
  const std::vector<PathRow> paths = download_rows(rows);
  for (size_t i = 0; i < paths.size(); ++i) {
    std::vector<uint32_t> mirrors = paths[i].steps;
    const uint32_t tile = mirrors.back();
    mirrors.pop_back();
    CHECK((tile & WT_STEP_KIND) == WT_STEP_SCATTERING);
    CHECK(out.emplace(PointPrefix{headers[i].transmitter, mirrors, tile & ~WT_STEP_KIND}, paths[i].points).second);
  }
  return out;
}

}  // namespace wavetracer::test
