// SPDX-License-Identifier: Apache-2.0
// Tests a road drawn on the ground, both in one plane: the paths are the same whichever of the two comes first in the
// file, and they are those of the road alone.
#include "simulation/run.hpp"
#include "simulation/world_fixture.hpp"
#include "simulation/world_models.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const Part drawn_ground{{{{-100, -100, 0}, {200, 0, 0}, {0, 200, 0}}}, "concrete"};
const Part drawn_road{{{{-50, -5, 0}, {100, 0, 0}, {0, 10, 0}}}, "metal"};

Paths drawn_paths(const std::vector<Part>& parts, bool more_kinds) {
  const SceneFile file(parts);
  Config config = config_of(file.path(), {{0, 0, 6}}, {{30, 0, 1.5}}, 20000, 2);
  config.trace.diffraction = config.trace.transmission = more_kinds;
  return run(config).paths;
}

}  // namespace

TEST_CASE("a road drawn on the ground reflects as it does alone, to the last bit, in either order") {
  const Paths alone = drawn_paths({drawn_road}, false);
  REQUIRE(alone.size() == 2);
  for (const bool more_kinds : {false, true}) {
    const Paths below = drawn_paths({drawn_ground, drawn_road}, more_kinds),
                above = drawn_paths({drawn_road, drawn_ground}, more_kinds);
    REQUIRE(below.size() == 2);  // nothing diffracts at the border of the road
    CHECK(below.gain_db == above.gain_db);
    CHECK(below.gain_db == alone.gain_db);
    CHECK(below.delay_s == above.delay_s);
    CHECK(below.vertex_position_m == above.vertex_position_m);
  }
}

TEST_CASE("a body of a vehicle has one material in each place") {
  const Part body{{{{-2, 1, 0.3}, {4, 0, 0}, {0, 0, 1.2}}, {{-2, 1, 1.5}, {4, 0, 0}, {0, -2, 0}}}, "metal"},
      glass{{{{-1, 1, 0.8}, {2, 0, 0}, {0, 0, 0.5}}}, "glass"};  // a window on the side of a body that has a roof
  for (const SceneFile& file : {SceneFile({body, glass}), SceneFile({glass, body})}) {
    Config config;
    config.tracks = {{"ego", "passenger", {{0, 10, 20, 0}, {2, 10, 40, 0}}}};
    config.time.step_s = 1;
    config.transmitters = {end("rsu", {0, 0, 6})};
    config.mounts = {mount("roof", "ego", "both", {0, 0, 2})};
    config.vehicle_types = {{.name = "passenger", .model = file.path().string()}};
    const World world = make_world(config, static_scene());
    const Scene& model = world.fleet.models.at(0);
    CHECK(model.report.covered_m2 == doctest::Approx(1));
    CHECK(model.surfaces.size() == 3);
    const std::vector<std::string> said = model_warnings(world.fleet.models, static_scene());
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("on 1 m2") != std::string::npos);
  }
}
