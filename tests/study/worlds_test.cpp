// SPDX-License-Identifier: Apache-2.0
// Tests the worlds of experiments that move, without a device: what transmits, what receives, and where it is in which
// frame. Places are computed by hand, from a transmitter's velocity.
#include "study/worlds.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include "contains.hpp"
#include "scene/load.hpp"
#include "simulation/world.hpp"
#include "study/city.hpp"
#include "study/coherence_frames.hpp"
#include "study/experiment.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

const std::string blocks = "scene.generate = \"--blocks 1\"\n";
const std::string car = "[[receiver]]\nname = \"car\"\nposition_m = [30, -50, 2]\n";

// Ends whose presence in each frame is a row of text: "x" where they are there.
struct MadeWorld {
  std::vector<std::string> there;
  std::vector<bool> mounted;

  Drive drive(uint32_t frames, uint32_t least) const {
    std::vector<RadioEnd> ends(there.size());
    for (size_t i = 0; i < ends.size(); ++i) ends[i].name = std::to_string(i);
    const auto state = [this](uint32_t frame) {
      WorldState out;
      out.time_s = 0.5 * frame;
      for (size_t i = 0; i < there.size(); ++i) {
        const double along_m = 3.0 * frame;
        out.transmitters.push_back({.position_m = {along_m, 0, 0},
                                    .instance = mounted[i] ? 0u : no_instance,
                                    .present = there[i][frame] == 'x'});
      }
      return out;
    };
    return plan_drive(ends, state, there[0].size(), {100, 0, 0}, frames, least, "a.toml: ");
  }
};

}  // namespace

TEST_CASE("traffic: the cold frame and those that count, by a mast or by vehicles, by spheres or exactly") {
  for (const auto& [drive, moving, spheres] :
       {std::tuple{"fixed", false, false}, {"moving", true, false}, {"spheres", false, true}, {"thesis", true, true}}) {
    CAPTURE(drive);
    const Config config = with_traffic(city(), drive, 500);
    CHECK(config.time.step_s == doctest::Approx(0.01));
    CHECK(*config.time.end_s == doctest::Approx(5));
    CHECK(contains(config.trajectories.generate, "--seed 1 --blocks 6x6 --vehicles 20 --seconds 6"));
    CHECK(config.trace.reception.word() == (spheres ? "sphere" : "exact"));
    CHECK(config.transmitters.size() == (moving ? 0 : 1));
    const auto senders =
        std::ranges::count(config.mounts, true, [](const MountConfig& mount) { return sends(mount.role); });
    CHECK(senders == (moving ? 3 : 0));
  }
}

TEST_CASE("the thesis' world: all that sends moves, from the first frame to the last") {
  const Config config = with_traffic(city(), "thesis", 20);
  const Scene scene = load_scene(config);
  const World world = make_world(config, scene);
  REQUIRE(world.clock.frame_count() == 21);
  REQUIRE(world.transmitters.ends.size() == 3);
  const WorldState first = world.state(0), last = world.state(20);
  for (size_t i = 0; i < 3; ++i) {
    CHECK(first.transmitters[i].present);
    CHECK(last.transmitters[i].present);
    CHECK(glm::distance(first.transmitters[i].position_m, last.transmitters[i].position_m) > 0.5);
  }
  CHECK(world.receivers.ends.size() == 20 + 96 + city().receivers.size());
}

TEST_CASE("a standing transmitter is driven as its velocity says, else at 50 km/h along +x, and nothing else sends") {
  const std::string links = "links.transmitters = [\"mast\"]\nlinks.v2i = false\n",
                    mast = "[[transmitter]]\nname = \"mast\"\nposition_m = [0, -50, 6]\n",
                    other = "[[transmitter]]\nname = \"other\"\nposition_m = [9, -50, 6]\n";
  for (const auto& [velocity, expected] : {std::pair{"", glm::dvec3{13.9, 0, 0}},
                                           {"velocity_m_s = [0, -3, 4]\n", {0, -3, 4}},
                                           {"velocity_m_s = [0, 0, 2]\n", {0, 0, 2}}}) {
    CAPTURE(velocity);
    const Config standing = parse_config(blocks + links + mast + velocity + other + car, "a.toml");
    CHECK_FALSE(has_vehicles(standing));
    const Config config = driven(standing, 100);
    CHECK_NOTHROW(parse_config(resolved_config(config), "resolved.toml"));
    CHECK(has_vehicles(config));
    const Scene scene = load_scene(config);
    const World world = make_world(config, scene);
    REQUIRE(world.clock.frame_count() == 101);
    REQUIRE(world.transmitters.ends.size() == 1);
    for (const uint32_t frame : {0u, 37u, 100u}) {
      const WorldState state = world.state(frame);
      CHECK(state.time_s == doctest::Approx(0.01 * frame));
      CHECK(state.links.size() == 1);
      const glm::dvec3 at = scene.origin_m + state.transmitters[0].position_m;
      CHECK(glm::distance(at, glm::dvec3{0, -50, 6} + 0.01 * frame * expected) < 1e-9);
    }
  }
}

TEST_CASE("of stations the first is driven, all of them listen where they stand, and no other sends") {
  const Config standing = parse_config(blocks + car +
                                           "[[station]]\nname = \"rsu\"\nposition_m = [0, -50, 6]\n[[station]]\n"
                                           "name = \"far\"\nposition_m = [0, 90, 6]\n",
                                       "a.toml");
  const Config config = driven(standing, 10);
  CHECK_NOTHROW(parse_config(resolved_config(config), "resolved.toml"));
  const World world = make_world(config, load_scene(config));
  REQUIRE(world.transmitters.ends.size() == 1);
  CHECK(world.transmitters.ends[0].name == "rsu/rsu");
  std::vector<std::string> names;
  for (const RadioEnd& end : world.receivers.ends) names.push_back(end.name);
  CHECK(names == std::vector<std::string>{"car", "rsu", "far"});
}

TEST_CASE("worlds that move: the file's own vehicles, traffic in the built-in city, else a driven transmitter") {
  const std::string vehicles =
      "[[mount]]\nname = \"roof\"\n[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -3, 0], [1, 20, -3, 0]]\n";
  const Config own = parse_config(blocks + vehicles, "a.toml");
  CHECK(resolved_config(moving_world(own, "moving", 7)) == resolved_config(own));
  CHECK(moving_world(city(), "thesis", 7).mounts.size() == 4);
  const Config standing =
      parse_config(blocks + car + "[[transmitter]]\nname = \"mast\"\nposition_m = [0, -50, 6]\n", "a.toml");
  CHECK(moving_world(standing, "thesis", 7).tracks.size() == 1);
  Config nobody = standing;
  nobody.transmitters.clear();
  CHECK_THROWS_WITH_AS(driven(nobody, 7), doctest::Contains("a.toml: nothing that sends can be driven"), ConfigError);
}

TEST_CASE("a drive is of a transmitter on a vehicle, in frames in which it is there all the time") {
  const MadeWorld world{{"xxxxxxxx", "xx.xxxx.", "...xxxxx"}, {false, true, true}};
  const Drive four = world.drive(4, 2);
  CHECK(four.transmitter == 1);
  CHECK(four.name == "1");
  CHECK(four.first == 3);
  CHECK(four.frames() == 4);
  CHECK(four.time_s(0) == 0);
  CHECK(four.time_s(3) == doctest::Approx(1.5));
  CHECK(four.place_m.front().x == doctest::Approx(109));
  CHECK(four.moved_m(3) == doctest::Approx(9));
  CHECK(world.drive(2, 2).first == 0);
  const Drive five = world.drive(100, 2);  // as many as there are
  CHECK(five.transmitter == 2);
  CHECK(five.frames() == 5);
  CHECK(MadeWorld{{"xxxx"}, {false}}.drive(3, 2).frames() == 3);  // the fixed end, where no end moves
  CHECK_THROWS_WITH_AS(MadeWorld({{"x.x."}, {true}}).drive(3, 2),
                       doctest::Contains("a.toml: no transmitter is there in 2 frames that follow each other (4 "),
                       ConfigError);
  CHECK_THROWS_AS(MadeWorld({{"..."}, {true}}).drive(1, 1), ConfigError);
}
