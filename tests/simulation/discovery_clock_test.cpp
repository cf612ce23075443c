// SPDX-License-Identifier: Apache-2.0
// Tests when frames launch rays, depending on times and on which ends are present.
#include "simulation/discovery_clock.hpp"

#include <doctest/doctest.h>

using namespace wavetracer;

namespace {

WorldState world_at(double time_s) {
  WorldState world;
  world.time_s = time_s;
  world.instances.resize(2);
  world.transmitters.resize(3);
  world.receivers.resize(1);
  world.links = {{0, 0}, {1, 0}};
  return world;
}

}  // namespace

TEST_CASE("rays are launched when the interval has passed, to a rounding error, and where a frame is cold") {
  DiscoveryClock clock(0.1);
  DiscoveryMark last;
  CHECK(clock.spares());
  int launches = 0;
  for (int frame = 0; frame <= 1000; ++frame) {
    const bool due = clock.due(world_at(7 + frame * 0.001), frame == 0, last);
    CHECK(due == (frame % 100 == 0));
    launches += due;
  }
  CHECK(launches == 11);
  CHECK(clock.due(world_at(8.05), true, last));
  CHECK_FALSE(clock.due(world_at(8.1), false, last));  // counted from the frame that started cold
  CHECK(clock.due(world_at(8.15), false, last));
  CHECK(clock.due(world_at(2), false, last));  // time may go backwards
}

TEST_CASE("intervals hold for times since 1970, which doubles keep to a fraction of a microsecond") {
  for (const double zero_s : {1.7e9, 1.7e9 + 0.3}) {
    DiscoveryClock clock(0.1);
    DiscoveryMark last;
    for (int frame = 0; frame <= 1000; ++frame)
      CHECK(clock.due(world_at(zero_s + frame * 0.01), frame == 0, last) == (frame % 10 == 0));
  }
}

TEST_CASE("without an interval every frame launches rays") {
  DiscoveryClock clock(0);
  DiscoveryMark last;
  CHECK_FALSE(clock.spares());
  for (int frame = 0; frame < 3; ++frame) CHECK(clock.due(world_at(0.001 * frame), false, last));
}

TEST_CASE("shards that are as short as the interval are warned of, because nothing is measured in them") {
  CHECK_FALSE(unmeasured_warning(0, 0.001, 1000, 100));
  CHECK_FALSE(unmeasured_warning(0.1, 0.001, 100, 100));  // one shard
  CHECK_FALSE(unmeasured_warning(0.1, 0.001, 1000, 101));
  const auto text = unmeasured_warning(0.1, 0.001, 1000, 100);
  REQUIRE(text);
  CHECK(text->find("output.shard_frames = 100 frames (0.1 s)") != std::string::npos);
  CHECK(text->find("give output.shard_frames = 1000 or more") != std::string::npos);
}

TEST_CASE("who was not there when rays were launched makes them due, who leaves does not") {
  DiscoveryClock clock(1);
  DiscoveryMark last;
  WorldState world = world_at(0);
  world.instances[1].present = false;
  CHECK(clock.due(world, true, last));
  world.time_s = 0.1;
  CHECK_FALSE(clock.due(world, false, last));
  world.instances[1].present = true;
  CHECK(clock.due(world, false, last));
  world.time_s = 0.2;
  world.instances[0].present = false;
  CHECK_FALSE(clock.due(world, false, last));
  world.links.push_back({2, 0});  // begins to transmit
  CHECK(clock.due(world, false, last));
  world.links = {{2, 0}};
  CHECK_FALSE(clock.due(world, false, last));
}

TEST_CASE("who comes to the place of another one makes rays due, and sources of poses do not count for each other") {
  DiscoveryClock clock(1);
  DiscoveryMark first, second;
  WorldState world = world_at(0);
  CHECK(clock.due(world, false, first));
  world.time_s = 0.5;
  CHECK_FALSE(clock.due(world, false, first));
  world.arrivals = true;
  CHECK(clock.due(world, false, first));
  world.arrivals = false;
  CHECK(clock.due(world, false, second));
  world.time_s = 1.2;
  CHECK_FALSE(clock.due(world, false, first));
  world.time_s = 1.5;
  CHECK(clock.due(world, false, first));
  CHECK(clock.due(world, false, second));
}
