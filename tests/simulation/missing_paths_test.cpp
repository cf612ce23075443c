// SPDX-License-Identifier: Apache-2.0
// Tests the reason why a link has no path: what its direct line meets, with walls that the tests place, and what the
// message proposes.
#include "simulation/missing_paths.hpp"

#include "scene/load.hpp"
#include "simulation/feature_choice.hpp"
#include "simulation/place_cases.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Quad wall(double x) { return {{x, -20, 0}, {0, 40, 0}, {0, 0, 20}}; }
const Points left{{-10, 0, 2}}, right{{10, 0, 2}};

// found: links that have a path.
MissingLinks missing(const std::vector<Part>& parts, const Config& config, const std::vector<Link>& found = {}) {
  const SceneFile file(parts);
  const Scene scene = load_scene_file(file.path(), {});
  const World world = make_world(config, scene);
  FrameResult frame;
  frame.world = world.state(0);
  for (const Link& link : found) {
    frame.paths.tx.push_back(link.tx);
    frame.paths.rx.push_back(link.rx);
    frame.paths.delay_s.push_back(0);
  }
  return explain_missing(config, choose_features(config, scene, world), Surroundings(scene), world, frame);
}

Texts texts(const std::vector<Part>& parts, const Config& config, const std::vector<Link>& found = {}) {
  return Texts(missing(parts, config, found).why);
}

}  // namespace

TEST_CASE("two walls of concrete: the first one, where, and how many transmissions pass them") {
  const std::vector<Part> parts{{{ground}}, {{wall(-4)}, "concrete"}, {{wall(3)}, "concrete"}};
  Config config = config_of("", left, right, 1, 3);
  CHECK(texts(parts, config) ==
        Texts{"tx0 -> rx0 has no path: its direct line meets \"part-1\" (material-1) after 6 m; "
              "trace.transmission = true lets it through 2 walls; what may lead around it: trace.diffraction = true, "
              "more than trace.max_depth = 3"});
  config.trace.max_transmissions = config.trace.max_depth = 1;
  config.trace.diffraction = config.trace.transmission = true;
  CHECK(texts(parts, config) ==
        Texts{"tx0 -> rx0 has no path: its direct line meets \"part-1\" (material-1) after 6 m; "
              "trace.max_transmissions = 2 and trace.max_depth = 2 lets it through 2 walls; what may lead around it: "
              "more than trace.max_depth = 1"});
  config.trace.diffraction = config.trace.transmission = false;
  config.trace.discovery = "beams";
  config.trace.floor_db = -90;
  CHECK(texts(parts, config).front().ends_with("more than trace.max_depth = 1, less than trace.floor_db = -90"));
}

TEST_CASE("metal lets nothing through; reflection that is off is named; a link that has a path is not") {
  const std::vector<Part> parts{{{ground}}, {{wall(0)}}};
  Config config = config_of("", left, {right[0], {-30, 5, 2}}, 1, 3);
  config.trace.reflection = false;
  const std::vector<Link> found{{0, 1}};
  CHECK(
      texts(parts, config, found) ==
      Texts{
          "tx0 -> rx0 has no path: its direct line meets \"part-1\" (material-1) after 10 m; what may lead around it: "
          "trace.reflection = true, trace.diffraction = true"});
  CHECK(texts(parts, config, {{0, 0}, {0, 1}}).empty());
}

TEST_CASE("out of a closed house only transmission helps, and out of one of metal nothing") {
  const auto house = reference::box_walls({-15, -5, 0}, {-5, 5, 6});
  const Config config = config_of("", left, right, 1, 3);
  CHECK(texts({{{ground}}, {house, "concrete"}}, config) ==
        Texts{"tx0 -> rx0 has no path: its direct line meets \"part-1\" (material-1) after 5 m; "
              "trace.transmission = true lets it through 1 wall"});
  CHECK(texts({{{ground}}, {house}}, config) ==
        Texts{"tx0 -> rx0 has no path: its direct line meets \"part-1\" (material-1) after 5 m"});
}

TEST_CASE("a vehicle in the way is named; the one that carries the antenna is not in the way") {
  Config config = config_of("", {{-10, 0, 0.8}}, {}, 1, 3);
  config.tracks = {{"truck", "truck", {{0, 0, 0, 0}}}, {"ego", "passenger", {{0, 10, 0, 0}}}};
  MountConfig mount;
  mount.name = "inside";
  mount.on = "ego";
  mount.role = "receiver";
  mount.offset_m = {0, 0, 0.8};
  config.mounts = {mount};
  const Texts out = texts({{{ground}}}, config);
  REQUIRE(out.size() == 1);
  CHECK(out[0].find("tx0 -> ego/inside has no path: its direct line meets vehicle \"truck\" (metal) after ") == 0);
}

TEST_CASE("five links by name, all counted, and cells of grids apart") {
  const std::vector<Part> parts{{{ground}}, {{wall(0)}}};
  Points receivers;
  for (int i = 0; i < 9; ++i) receivers.push_back({10, 0.1 * i, 2});
  Config config = config_of("", left, receivers, 1, 3);
  config.receiver_grids = {{.name = "g", .x_min_m = 5, .x_max_m = 15, .y_min_m = -5, .y_max_m = 5, .step_m = 5}};
  const MissingLinks out = missing(parts, config, {{0, 1}, {0, 1}, {0, 8}, {0, 10}});
  CHECK(out.links == 7);
  CHECK(out.why.size() == 5);
  CHECK(out.why[1].find("tx0 -> rx2 has no path") == 0);
  CHECK(out.in_grids == 3);
  REQUIRE(out.why_in_grids.size() == 3);
  CHECK(out.why_in_grids[1].find("tx0 -> g/0,1 has no path") == 0);
}
