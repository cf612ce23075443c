// SPDX-License-Identifier: Apache-2.0
// SharedList: copies are one memory until one of them changes. A world at rest and its frames share their ends.
#include "wavetracer/shared_list.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "simulation/run_plan.hpp"

using namespace wavetracer;

TEST_CASE("copies share their memory, and a change of one does not show in another") {
  SharedList<std::string> a{"one", "two"};
  const SharedList<std::string> b = a;
  CHECK(std::as_const(a).data() == b.data());
  a[0] = "other";
  CHECK(a.values() == std::vector<std::string>{"other", "two"});
  CHECK(b.values() == std::vector<std::string>{"one", "two"});
  const std::string* const own = std::as_const(a).data();
  a[1] = "again";  // no copy is left, so it stays where it is
  CHECK(std::as_const(a).data() == own);
  const SharedList<std::string> c = a;
  a.clear();
  CHECK(a.empty());
  CHECK(c.size() == 2);
  a.push_back("new");
  CHECK(a.size() == 1);
  CHECK((c == SharedList<std::string>{"other", "again"}));
}

TEST_CASE("the ends of a map are in memory once: those of its configuration, and their states in a world at rest") {
  Config config;
  config.transmitters = {{.name = "mast"}};
  config.receivers = {{.name = "g/00,0"}, {.name = "g/20,0"}, {.name = "g/0,0,0"}};  // names that no cell has
  ReceiverGridConfig& grid = config.receiver_grids.emplace_back();
  grid.name = "g";
  grid.x_min_m = grid.y_min_m = 0;
  grid.x_max_m = grid.y_max_m = 20;
  grid.step_m = 1;
  Scene scene;
  scene.lower = glm::dvec3(-10);
  scene.upper = glm::dvec3(30);
  const RunPlan plan = plan_run(config, scene, false);
  REQUIRE(plan.asked.receivers.size() == 403);
  CHECK(plan.asked.receivers.data() == plan.world.receivers.ends.data());
  const Config computed = plan.computed();
  CHECK(computed.receivers.data() == plan.asked.receivers.data());
  const WorldState first = plan.world.state(0), again = plan.world.state(0);
  CHECK(first.receivers.data() == again.receivers.data());
  CHECK(first.receivers.data() == plan.world.receivers.standing.data());
}
