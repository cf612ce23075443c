// SPDX-License-Identifier: Apache-2.0
// The tables of moving worlds: accepted and refused values, the places of errors, and that a resolved config reads
// back. Texts are written here by hand; lines and columns are counted in them, not computed by the parser.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

const std::string track = "[[track]]\nid = \"ego\"\nwaypoints = [[0, 0, 0, 0], [1, 10, 0, 0]]\n";

const std::string everything = R"(
scene.file = "s.xml"
[trajectories]
file = "drive.fcd.xml.gz"
offset_m = [-100, 20.5, 0]
scale = 0.5
persons = true
containers = true
default_type = "passenger"
[time]
start_s = 10
end_s = 20.5
step_s = 0.1
[links]
max_distance_m = 300
transmitters = "rsu*"
receivers = ["*/roof", "r"]
v2v = false
v2i = false
i2i = false
same_vehicle = true
[trace]
rays = "auto"
recall = 0.95
max_rays = 2e6
reuse = false
refresh_rays = 1000
forget_frames = 7
[output]
shard_frames = 10
[[mount]]
name = "roof"
on = "veh?"
role = "receiver"
offset_m = [0.5, 0, 1.6]
antenna = "patterns/roof.csv"
polarization = "VH"
orientation_deg = [180, 0, 5]
[[mount]]
name = "bumper"
role = "transmitter"
[[vehicle_type]]
name = "ego"
model = "cars/ego.glb"
length_m = 4.5
width_m = 1.9
height_m = 1.4
material = "glass"
[[track]]
id = "ego \"1\""
type = "ego"
waypoints = [
  [0, 691234.123456789, -0.5, 0],  # metres east
  [2.5, 691240, 1e-3, 0.1],
]
)";

}  // namespace

TEST_CASE("every key of a moving world is read") {
  const Config c = parse_config(everything, "/data/a.toml");
  CHECK(c.trajectories.file == "/data/drive.fcd.xml.gz");
  CHECK(c.trajectories.offset_m == std::array<double, 3>{-100, 20.5, 0});
  CHECK(c.trajectories.scale == 0.5);
  CHECK(c.trajectories.persons);
  CHECK(c.trajectories.containers);
  CHECK(c.trajectories.default_type == "passenger");
  CHECK(*c.time.start_s == 10);
  CHECK(*c.time.end_s == 20.5);
  CHECK(c.time.step_s == 0.1);
  CHECK(c.links.max_distance_m == 300);
  CHECK(c.links.transmitters == std::vector<std::string>{"rsu*"});
  CHECK(c.links.receivers == std::vector<std::string>{"*/roof", "r"});
  CHECK_FALSE((c.links.v2v || c.links.v2i || c.links.i2i));
  CHECK(c.links.same_vehicle);
  CHECK_FALSE(c.trace.rays);
  CHECK(c.trace.recall == 0.95);
  CHECK(c.trace.max_rays == 2000000);
  CHECK_FALSE(c.trace.reuse);
  CHECK(c.trace.refresh_rays == 1000);
  CHECK(c.trace.forget_frames == 7);
  CHECK(c.output.shard_frames == 10);
  REQUIRE(c.mounts.size() == 2);
  CHECK(c.mounts[0].on == "veh?");
  CHECK(c.mounts[0].role.word() == "receiver");
  CHECK(c.mounts[0].offset_m == std::array<double, 3>{0.5, 0, 1.6});
  CHECK(c.mounts[0].antenna == "/data/patterns/roof.csv");
  CHECK(c.mounts[0].polarization.word() == "VH");
  CHECK(c.mounts[0].orientation_deg == std::array<double, 3>{180, 0, 5});
  CHECK(c.mounts[1].on == "*");
  REQUIRE(c.vehicle_types.size() == 1);
  CHECK(c.vehicle_types[0].model == "/data/cars/ego.glb");
  CHECK(c.vehicle_types[0].height_m == 1.4);
  CHECK(c.vehicle_types[0].material == "glass");
  REQUIRE(c.tracks.size() == 1);
  CHECK(c.tracks[0].id == "ego \"1\"");
  REQUIRE(c.tracks[0].waypoints.size() == 2);
  CHECK(c.tracks[0].waypoints[0] == std::array<double, 4>{0, 691234.123456789, -0.5, 0});
  CHECK(c.tracks[0].waypoints[1] == std::array<double, 4>{2.5, 691240, 1e-3, 0.1});
}

TEST_CASE("the resolved config of a moving world reads back the same") {
  const Config c = parse_config(everything, "/data/a.toml"), d = parse_config(c.text, "/elsewhere/b.toml");
  CHECK(d.text == c.text);
  CHECK(d.tracks[0].waypoints == c.tracks[0].waypoints);
  CHECK(d.links.receivers == c.links.receivers);
  CHECK_FALSE(d.trace.rays);
  check_contains(c.text, "rays = \"auto\"\n");
  const Config plain = parse_config(parse_config(scene + ends, "a.toml").text, "a.toml");
  CHECK(std::isinf(plain.links.max_distance_m));
  CHECK_FALSE(plain.time.start_s.has_value());
  CHECK(plain.links.transmitters == std::vector<std::string>{"*"});
  CHECK(plain.trace.rays == Config{}.trace.rays);
}

TEST_CASE("--set reaches the new keys") {
  const Config c = parse_config(everything, "/data/a.toml",
                                {"links.transmitters=veh*", "links.receivers=[\"a\", \"b\"]", "trace.rays=1e5",
                                 "time.end_s=30", "mount.1.on=truck", "track.0.waypoints=[[0, 1, 2, 3]]",
                                 "links.max_distance_m=inf", "vehicle_type.0.model=none"});
  CHECK(c.links.transmitters == std::vector<std::string>{"veh*"});
  CHECK(c.links.receivers == std::vector<std::string>{"a", "b"});
  CHECK(c.trace.rays == 100000);
  CHECK(*c.time.end_s == 30);
  CHECK(c.mounts[1].on == "truck");
  CHECK(c.tracks[0].waypoints == std::vector<std::array<double, 4>>{{0, 1, 2, 3}});
  CHECK(std::isinf(c.links.max_distance_m));
  CHECK(c.vehicle_types[0].model == "none");
  CHECK_FALSE(parse_config(scene + ends, "a.toml", {"trace.rays=auto"}).trace.rays);
  check_contains(error_of(scene + ends, {"mount.0.on=x"}), "the file has 0 [[mount]]");
}

TEST_CASE("values that are no such thing, with their place") {
  check_contains(error_of(scene + "trace.rays = \"many\"\n" + ends),
                 "a.toml:2:14: trace.rays must be an integer from 1 to 2147483648 (rays per transmitter) or \"auto\"");
  check_contains(error_of(scene + "links.transmitters = 3\n" + ends),
                 "a.toml:2:22: links.transmitters must be a string or an array of strings, not an integer");
  check_contains(error_of(scene + "links.receivers = [\"a\", 3]\n" + ends),
                 "a.toml:2:19: links.receivers[1] must be a string, not an integer");
  check_contains(error_of(scene + "links.receivers = []\n" + ends), "links.receivers is empty");
  check_contains(error_of(scene + "links.max_distance_m = 0\n" + ends), "it must be a number above 0 up to inf (m)");
  check_contains(error_of(scene + "output.shard_frames = 0\n" + ends), "output.shard_frames = 0 is out of range");
  check_contains(error_of(scene + "trace.recall = 1.5\n" + ends), "trace.recall = 1.5 is out of range");
  check_contains(error_of(scene + ends + "[[mount]]\nname = \"m\"\nrole = \"recever\"\n"),
                 "did you mean \"receiver\"?");
  check_contains(error_of(scene + ends + "[[mount]]\nname = \"m\"\nof = \"x\"\n"), "did you mean \"mount.on\"?");
  check_contains(error_of(scene + ends + "[[vehicle_type]]\nname = \"m\"\nmodel = \"truk\"\n"),
                 "a.toml:10:9: vehicle_type.model = \"truk\" is not a known value");
  const auto waypoints = [](const std::string& value) {
    return error_of(scene + ends + "[[track]]\nid = \"e\"\nwaypoints = " + value + "\n");
  };
  check_contains(
      waypoints("3"),
      "a.toml:10:13: track.waypoints must be an array of [time, x, y, z] from -1e+12 to 1e+12 (s, m, m, m), not");
  check_contains(waypoints("[[0, 1, 2]]"), "track.waypoints[0] must be four numbers (s, m, m, m), not 3");
  check_contains(waypoints("[[0, 1, 2, 3], 4]"), "track.waypoints[1] must be four numbers (s, m, m, m), not an int");
  check_contains(waypoints("[[0, 1, 2, nan]]"), "track.waypoints[0][3] = nan is out of range");
  check_contains(waypoints("[[0, 1, \"2\", 3]]"), "track.waypoints[0][2] must be a number, not a string");
  check_contains(waypoints("[]"), "track.waypoints is empty");
}

TEST_CASE("what contradicts itself, with its place") {
  check_contains(error_of(scene + "[trajectories]\nfile = \"a.xml\"\ngenerate = \"--vehicles 3\"\n" + ends),
                 "a.toml:4:12: trajectories.file and trajectories.generate exclude each other");
  CHECK(error_of(scene + "[trajectories]\nfile = \"a.xml\"\n" + ends + track) == "no error");
  CHECK(error_of(scene + "[trajectories]\ngenerate = \"--vehicles 3\"\n" + ends + track) == "no error");
  check_contains(error_of(scene + ends + "[[mount]]\nname = \"m\"\n"), "a.toml:8:1: [[mount]] needs vehicles: give");
  check_contains(error_of(scene + ends + track + "[[mount]]\nname = \"m\"\n[[mount]]\nname = \"m\"\n"),
                 "a.toml:14:8: mount.name = \"m\" is used twice");
  check_contains(error_of(scene + ends + track + track),
                 "a.toml:12:6: track.id = \"ego\" is used twice: each id must be unique");
  check_contains(error_of(scene + ends + "[[vehicle_type]]\nname = \"m\"\n[[vehicle_type]]\nname = \"m\"\n"),
                 "a.toml:11:8: vehicle_type.name = \"m\" is used twice");
  check_contains(
      error_of(scene + ends + "[[track]]\nid = \"e\"\nwaypoints = [[0, 1, 2, 3], [2, 1, 2, 3], [2, 1, 2, 3]]\n"),
      "a.toml:10:13: track.waypoints[2] is at 2 s, but the waypoint before it is at 2 s: times must increase");
  check_contains(error_of(scene + "time.start_s = 3\ntime.end_s = 2\n" + ends),
                 "a.toml:3:14: time.end_s = 2 is before time.start_s = 3");
  check_contains(error_of(scene + ends + "[[track]]\nid = \"e\"\n"), "a.toml:8:1: [[track]] has no waypoints: give it");
  check_contains(error_of(scene + ends + "[[mount]]\non = \"e\"\n" + track), "a.toml:8:1: [[mount]] has no name");
}

TEST_CASE("a refined launch goes along the hilbert curve and nothing else") {
  const std::string automatic = scene + "trace.rays = \"auto\"\n";
  CHECK(error_of(automatic + "trace.directions = \"hilbert\"\norder.method = \"none\"\n" + ends) == "no error");
  CHECK(error_of(automatic + "order.method = \"WS\"\n" + ends) == "no error");
  CHECK(error_of(automatic + "trace.directions = \"random\"\n" + ends) ==
        "a.toml:3:20: trace.rays = \"auto\" needs trace.directions = \"horizon\" or \"hilbert\", not \"random\": "
        "remove trace.directions, or give trace.rays a number");
  for (const std::string method : {"Z", "direction-origin", "auto"})
    check_contains(error_of(automatic + "order.method = \"" + method + "\"\n" + ends),
                   "a.toml:3:16: trace.rays = \"auto\" launches rays in its own order, but order.method = \"" + method +
                       "\" asks for another one: remove order.method");
  // The last key is reported, and --set comes after the file.
  check_contains(error_of(scene + "order.method = \"Z\"\n" + ends, {"trace.rays=auto"}), "--set trace.rays=auto: ");
  CHECK(error_of(automatic + "order.method = \"Z\"\n" + ends, {"trace.rays=1000"}) == "no error");
}

TEST_CASE("frames that reuse launch no more rays than those that do not, and forget after one frame at least") {
  check_contains(error_of(scene + "trace.refresh_rays = 1001\ntrace.rays = 1000\n" + ends),
                 "a.toml:3:14: trace.refresh_rays = 1001 is more than trace.rays = 1000");
  check_contains(error_of(scene + "trace.rays = 1000\ntrace.refresh_rays = 1001\n" + ends), "a.toml:3:22: ");
  CHECK(error_of(scene + "trace.rays = 1000\ntrace.refresh_rays = 1000\n" + ends) == "no error");
  CHECK(error_of(scene + "trace.rays = \"auto\"\ntrace.refresh_rays = 1000000\n" + ends) == "no error");
  check_contains(error_of(scene + "trace.forget_frames = 0\n" + ends),
                 "a.toml:2:23: trace.forget_frames = 0 is out of range");
  CHECK(error_of(scene + "trace.forget_frames = 1\n" + ends) == "no error");
}

TEST_CASE("discovery by beams is refused where something needs rays") {
  const std::string beams = scene + "trace.discovery = \"beams\"\n";
  CHECK(error_of(beams + ends) == "no error");
  CHECK(error_of(beams + "trace.rays = \"auto\"\n" + ends) == "no error");  // it is not used
  const auto refused = [&](const std::string& line, const std::string& words) {
    CAPTURE(line);
    check_contains(error_of(beams + line + "\n" + ends), "trace.discovery = \"beams\" launches no rays, but " + words);
    CHECK(error_of(scene + line + "\n" + ends) == "no error");
    CHECK(error_of(scene + "trace.discovery = \"auto\"\n" + line + "\n" + ends) == "no error");  // it takes rays
  };
  refused("trace.reception = \"sphere\"",
          "trace.reception = \"sphere\" takes its paths from the rays of the frame: remove trace.reception, or use");
  refused("cache.kind = \"open\"", "cache.kind = \"open\" answers rays of every frame: remove cache.kind");
  refused("output.waypoints = 5", "output.waypoints = 5 writes rays of every frame: remove output.waypoints");
  refused("trace.discover_every_s = 0.1", "trace.discover_every_s = 0.1 spares frames their rays: remove");
  check_contains(error_of(scene + "trace.discovery = \"beam\"\n" + ends), "did you mean \"beams\"");
}

TEST_CASE("a floor is refused without beams, and where edges or rough surfaces send waves") {
  const std::string floor = "trace.floor_db = -140\n", beams = scene + "trace.discovery = \"beams\"\n" + floor;
  CHECK(error_of(beams + "trace.max_depth = 64\ntrace.transmission = true\n" + ends) == "no error");
  for (const char* other : {"", "trace.discovery = \"auto\"\n"})
    check_contains(error_of(scene + other + floor + ends),
                   "trace.floor_db = -140 leaves out beams that are too weak, but rays are not left out: remove "
                   "trace.floor_db, or use trace.discovery = \"beams\"");
  check_contains(error_of(beams + "trace.diffraction = true\n" + ends),
                 "trace.floor_db = -140 says nothing of the power of waves that an edge diffracts: remove");
  check_contains(error_of(beams + "trace.scattering = true\n" + ends),
                 "trace.floor_db = -140 says nothing of the power of waves that a surface scatters: remove");
  check_contains(error_of(scene + "trace.floor_db = 3\n" + ends), "trace.floor_db = 3 is out of range");
}

TEST_CASE("frames without rays are refused where something needs the rays of every frame") {
  const std::string spared = scene + "trace.discover_every_s = 0.1\n";
  CHECK(error_of(spared + ends) == "no error");
  const auto refused = [&](const std::string& line, const std::string& words) {
    CAPTURE(line);
    check_contains(error_of(spared + line + "\n" + ends),
                   "trace.discover_every_s = 0.1 spares frames their rays, but ");
    check_contains(error_of(spared + line + "\n" + ends), words);
    CHECK(error_of(scene + "trace.discover_every_s = 0\n" + line + "\n" + ends) == "no error");
  };
  refused("trace.reuse = false", "set trace.reuse = true");
  refused("trace.reception = \"sphere\"", "remove trace.reception");
  refused("cache.kind = \"open\"", "remove cache.kind");
  refused("output.waypoints = 5", "remove output.waypoints");
  check_contains(error_of(scene + "trace.discover_every_s = -1\n" + ends), "is out of range");
}

TEST_CASE("mounts take the place of transmitters and receivers by their role") {
  const auto with = [](const std::string& role) {
    return error_of(scene + track + "[[mount]]\nname = \"m\"\nrole = \"" + role + "\"\n");
  };
  CHECK(with("both") == "no error");
  CHECK(with("transmitter") ==
        "a.toml:1:1: no [[receiver]]: add one with name and position_m, a [[station]], which sends and receives, "
        "or a [[mount]] with name and role = \"receiver\" or \"both\" for vehicles");
  check_contains(with("receiver"), "no [[transmitter]]: add one with name and position_m, a [[station]]");
}
