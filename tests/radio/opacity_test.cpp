// SPDX-License-Identifier: Apache-2.0
// Finds which surfaces let nothing through, and their numbers in a world.
#include "radio/opacity.hpp"

#include "radio/slab.hpp"
#include "radio/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

TEST_CASE("metals, half spaces and thick lossy walls are opaque; what is thin is not") {
  const Material metal{"metal", 1, 0, 1e7, 0, 1, 100, 0.001}, glass{"glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100, 0.01};
  CHECK(is_opaque(metal, 5.9e9));
  CHECK(is_opaque(test::medium_dry_ground(), 5.9e9));
  CHECK_FALSE(is_opaque(test::concrete(0.1), 5.9e9));
  CHECK_FALSE(is_opaque(glass, 5.9e9));
  // Concrete at 5.9 GHz loses exp(-k0 Im sqrt(eta) d): 15.2 / m, so 200 dB take 1.51 m.
  CHECK_FALSE(is_opaque(test::concrete(1.4), 5.9e9));
  CHECK(is_opaque(test::concrete(1.6), 5.9e9));
  CHECK_THROWS_AS(is_opaque(test::concrete(0.1), 0.5e9), ConfigError);
}

TEST_CASE("surfaces of instances have the numbers of the world; materials that nobody uses are not asked for") {
  test::World world, model;
  world.add_plane({0, 0, 1}, {0, 0, 0}, test::medium_dry_ground());
  world.add_plane({0, 0, 1}, {0, 0, 1}, test::concrete(0.1));
  world.scene.materials.push_back({"floorboard", 3.66, 0, 0.0044, 1.3515, 50, 100, 0.1});
  model.add_plane({0, 0, 1}, {0, 0, 0}, test::concrete(0.2));
  model.add_plane({1, 0, 0}, {0, 0, 0}, test::conductor());
  const std::vector<Scene> models{model.scene};
  const std::vector<Instance> instances{{"a", "car", 0, 2}, {"b", "car", 0, 4}};
  CHECK(opaque_surfaces(world.scene, models, instances, 5.9e9) ==
        std::vector<bool>{true, false, false, true, false, true});
}
