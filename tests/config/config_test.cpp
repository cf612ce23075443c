// SPDX-License-Identifier: Apache-2.0
// Config files: accepted values, the message of each kind of mistake, and that --set behaves as the file does. The
// texts are written here by hand; positions are counted in them, not computed by the parser.
#include <doctest/doctest.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include "config/retired_keys.hpp"
#include "config/texts.hpp"

namespace {

using wavetracer::Config;
using wavetracer::ConfigError;
using wavetracer::parse_config;
using wavetracer::test::check_contains;
using wavetracer::test::ends;
using wavetracer::test::error_of;
using wavetracer::test::scene;

}  // namespace

TEST_CASE("a minimal config keeps every default") {
  const Config c = parse_config(scene + ends, "/data/a.toml");
  const Config d;
  CHECK(c.scene.file == "/data/s.xml");
  CHECK(c.radio.frequency_hz == d.radio.frequency_hz);
  CHECK(c.trace.rays == d.trace.rays);
  CHECK(c.trace.max_depth == d.trace.max_depth);
  // Relative to the current folder, like -o, and not to the file.
  CHECK(c.output.directory == (std::filesystem::current_path() / "out").string());
  REQUIRE(c.transmitters.size() == 1);
  REQUIRE(c.receivers.size() == 1);
  CHECK(c.receivers[0].name == "r");
  CHECK(c.receivers[0].position_m == std::array<double, 3>{10, 0, 1.5});
}

TEST_CASE("every kind of value is read, dotted keys at the top and tables alike") {
  const Config c = parse_config(
      "scene.file = \"sub/../s.xml\"\nscene.scale = 2\nscene.up = \"y\"\nradio.frequency_hz = 28000000000.0\n"
      "trace.rays = 1e6\ntrace.seed = 9223372036854775807\ntrace.diffraction = false\n"
      "[scene.material_alias]\n\"my wall\" = \"concrete\"\ndoor = \"wood\"\n"
      "[order]\nmethod = \"WS\"\n[output]\ndirectory = \"/abs/out\"\n"
      "[[material]]\nname = \"m\"\npermittivity = 4\nthickness_m = inf\n" +
          ends,
      "/data/a.toml");
  CHECK(c.scene.file == "/data/s.xml");
  CHECK(c.scene.scale == 2.0);
  CHECK(c.scene.up.word() == "y");
  CHECK(c.radio.frequency_hz == 28e9);
  CHECK(c.trace.rays == 1000000);
  CHECK(c.trace.seed == 9223372036854775807u);
  CHECK(c.scene.material_alias == std::map<std::string, std::string>{{"my wall", "concrete"}, {"door", "wood"}});
  CHECK(c.order.method.word() == "WS");
  CHECK(c.output.directory == "/abs/out");
  REQUIRE(c.materials.size() == 1);
  CHECK(*c.materials[0].permittivity == 4.0);
  CHECK(std::isinf(*c.materials[0].thickness_m));
  CHECK_FALSE(c.materials[0].a.has_value());
}

TEST_CASE("the form that dotted keys before arrays of tables give is accepted") {
  const Config c = parse_config(
      "scene.file = \"/s.xml\"\nradio.frequency_hz = 3500000000.0\ntrace.rays = 1000000\ntrace.max_depth = 5\n"
      "trace.reflection = true\ntrace.diffraction = false\ntrace.transmission = false\ntrace.scattering = false\n"
      "[[transmitter]]\nname = \"tx0\"\nposition_m = [8.5, 21, 27]\nantenna = \"isotropic\"\npolarization = \"VH\"\n"
      "[[receiver]]\nname = \"rx0\"\nposition_m = [45, 90, 1.5]\nantenna = \"isotropic\"\npolarization = \"VH\"\n",
      "case.toml");
  CHECK(c.transmitters[0].polarization.word() == "VH");
  CHECK(c.radio.frequency_hz == 3.5e9);
}

TEST_CASE("an unknown key names its place and the nearest known key") {
  CHECK(error_of("scene.file = \"s.xml\"\n\n[trace]\n  ray = 5\n" + ends) ==
        "a.toml:4:3: unknown key \"trace.ray\"; did you mean \"trace.rays\"?");
  check_contains(error_of(scene + "trace.max_dpeth = 5\n" + ends),
                 "a.toml:2:7: unknown key \"trace.max_dpeth\"; did you mean \"trace.max_depth\"?");
  check_contains(error_of("rays = 5\n" + scene + ends),
                 "a.toml:1:1: unknown key \"rays\"; did you mean \"trace.rays\"?");
  check_contains(error_of("[trcae]\n" + ends), "unknown key \"trcae\"; did you mean \"trace\"?");
  check_contains(error_of(scene + ends + "positon_m = [0, 0, 0]\n"),
                 "a.toml:8:1: unknown key \"receiver.positon_m\"; did you mean \"receiver.position_m\"?");
  CHECK(error_of(scene + "completely.different = 1\n" + ends) == "a.toml:2:1: unknown key \"completely\"");
}

TEST_CASE("syntax errors and repeated keys carry their place") {
  check_contains(error_of("scene.file = \n" + ends), "a.toml:1:");
  check_contains(error_of("[trace]\nrays = 1\nrays = 2\n"), "a.toml:3:");
  check_contains(error_of("trace.rays = 99999999999999999999\n"), "a.toml:1:");
}

TEST_CASE("wrong types say what is expected") {
  check_contains(error_of(scene + "trace.rays = \"many\"\n" + ends),
                 "a.toml:2:14: trace.rays must be an integer from 1 ");
  check_contains(error_of(scene + "trace.rays = 1.5\n" + ends), "not a number with a fraction");
  check_contains(error_of(scene + "trace.reflection = 1\n" + ends),
                 "trace.reflection must be true or false, not an integer");
  check_contains(error_of(scene + "radio.frequency_hz = [1]\n" + ends), "radio.frequency_hz must be a number");
  check_contains(error_of("scene.file = 3\n" + ends),
                 "a.toml:1:14: scene.file must be the path of a file, not an integer");
  check_contains(error_of("trace = 3\n" + scene + ends), "a.toml:1:9: trace must be a table: write [trace]");
  check_contains(error_of(scene + "[transmitter]\nname = \"t\"\n"), "write [[transmitter]]");
  check_contains(error_of(scene + "[scene.material_alias]\nx = 1\n" + ends), "scene.material_alias.x must be a string");
}

TEST_CASE("numbers outside their range, NaN and infinity") {
  check_contains(error_of(scene + "trace.rays = 0\n" + ends),
                 "trace.rays = 0 is out of range: it must be an integer from 1 to");
  check_contains(error_of(scene + "trace.max_depth = 65\n" + ends), "from 0 to 64");
  check_contains(error_of(scene + "trace.max_depth = -1\n" + ends), "trace.max_depth = -1 is out of range");
  check_contains(error_of(scene + "radio.frequency_hz = nan\n" + ends), "radio.frequency_hz = nan is out of range");
  check_contains(error_of(scene + "radio.frequency_hz = inf\n" + ends), "out of range");
  check_contains(error_of(scene + "scene.scale = 0\n" + ends),
                 "scene.scale = 0 is out of range: it must be a number above 0");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"n\"\nposition_m = [0, nan, 0]\n"),
                 "receiver.position_m[1] = nan is out of range");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"n\"\nposition_m = [0, 0, -inf]\n"),
                 "receiver.position_m[2] = -inf is out of range");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"n\"\nposition_m = [0, 0]\n"),
                 "must be three numbers from -1000000000 to 1000000000 (m), not 2");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"n\"\nposition_m = [0, 0, \"1\"]\n"),
                 "receiver.position_m[2] must be a number, not a string");
}

TEST_CASE("choices are checked and hinted; an antenna may be a file") {
  check_contains(error_of(scene + "trace.directions = \"hilbrt\"\n" + ends), "did you mean \"hilbert\"?");
  check_contains(error_of(scene + ends + "antenna = \"isotropc\"\n"), "did you mean \"isotropic\"?");
  const Config c = parse_config(scene + ends + "antenna = \"patterns/roof.csv\"\n", "/data/a.toml");
  CHECK(c.receivers[0].antenna == "/data/patterns/roof.csv");
}

TEST_CASE("what is missing or said twice") {
  check_contains(error_of(ends), "a.toml:1:1: no scene: give scene.file");
  check_contains(error_of(scene), "no [[transmitter]]");
  check_contains(error_of(scene), "no [[receiver]]");
  check_contains(error_of(scene + ends + "[[receiver]]\nposition_m = [0, 0, 0]\n"),
                 "a.toml:8:1: [[receiver]] has no name");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"q\"\n"), "[[receiver]] has no position_m");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"t\"\nposition_m = [0, 0, 0]\n"),
                 "a.toml:9:8: receiver.name = \"t\" is used twice");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"\"\nposition_m = [0, 0, 0]\n"),
                 "receiver.name is empty");
  for (const char* character : {"\\n", "\\u0000", "\\u007f", "\\t"}) {
    const std::string name = std::string("name = \"a") + character + "b\"";
    const std::string error = error_of(scene + ends + "[[receiver]]\n" + name + "\nposition_m = [0, 0, 0]\n");
    check_contains(error, "a.toml:9:8: receiver.name = ");
    check_contains(error, "contains a control character");
  }
  check_contains(error_of("scene.generate = \"--seed 1\"\n" + scene + ends), "exclude each other");
  check_contains(error_of(scene + "[[material]]\nname = \"m\"\na = 2\npermittivity = 3\n" + ends),
                 "give either the first four or the last two");
}

TEST_CASE("all mistakes are reported at once, in the order of the file") {
  CHECK(error_of("zzz = 1\ntrace.max_depth = 99\naaa = 1\n" + scene + ends) ==
        "a.toml:1:1: unknown key \"zzz\"\n"
        "a.toml:2:19: trace.max_depth = 99 is out of range: it must be an integer from 0 to 64 (interactions)\n"
        "a.toml:3:1: unknown key \"aaa\"");
}

TEST_CASE("what a path may do: ranges of its keys") {
  const auto with = [](const std::string& keys) { return error_of(scene + keys + ends); };
  CHECK(with("trace.diffraction = true\ntrace.max_diffractions = 2\ntrace.transmission = true\n"
             "trace.max_transmissions = 3\ntrace.scattering = true\ntrace.tile_m = 2.5\n") == "no error");
  check_contains(with("trace.max_diffractions = 9\n"), "a.toml:2:26: trace.max_diffractions = 9 is out of range");
  check_contains(with("trace.max_transmissions = 0\n"), "out of range");
  check_contains(with("trace.tile_m = 0\n"), "out of range");
  check_contains(with("[[material]]\nname = \"brick\"\nscattering = 1.5\n"), "material.scattering = 1.5 is out");
}

TEST_CASE("a key that was taken away says what to do instead; false, which every run wrote down, asks for nothing") {
  const auto with = [](const std::string& keys, const std::vector<std::string>& sets = {}) {
    return error_of(scene + keys + ends, sets);
  };
  const std::string said =
      "trace.join no longer exists, because rays towards the horizon find more paths in the same time: "
      "remove the key, "
      "and keep trace.directions = \"horizon\"";
  CHECK(with("trace.join = true\n") == "a.toml:2:7: " + said);
  CHECK(with("trace.join = \"yes\"\n") == "a.toml:2:7: " + said);
  CHECK(with("", {"trace.join=true"}) == "--set trace.join=true: " + said);
  CHECK(with("trace.join = false\n") == "no error");
  CHECK(with("trace.join = true\n", {"trace.join=false"}) == "no error");
  CHECK(with("[trace]\njoin = true\nrays = 0.5\n").starts_with("a.toml:3:1: " + said + "\na.toml:4:8: "));
  check_contains(with("trace.joint = true\n"), "unknown key \"trace.joint\"");
  const Config old =
      parse_config(scene + "trace.join = true\n" + ends, "a.toml", wavetracer::config::without_retired_keys());
  CHECK(resolved_config(old) == resolved_config(parse_config(scene + ends, "a.toml")));
}

TEST_CASE("diffraction, transmission and scattering are refused beside what follows reflected rays alone") {
  const auto with = [](const std::string& keys) { return error_of(scene + keys + ends); };
  const std::string all = "trace.diffraction = true\ntrace.transmission = true\ntrace.scattering = true\n";
  CHECK(with(all + "trace.rays = \"auto\"\ncache.kind = \"concurrent\"\norder.each_depth = true\n") == "no error");
  for (const std::string key : {"trace.diffraction", "trace.transmission", "trace.scattering"}) {
    CAPTURE(key);
    CHECK(with(key + " = true\ntrace.reception = \"sphere\"\n") ==
          "a.toml:3:19: trace.reception = \"sphere\" receives reflected rays only, but " + key +
              " = true: set it to false, or use trace.reception = \"exact\"");
    CHECK(with(key + " = false\ntrace.reception = \"sphere\"\n") == "no error");
  }
  CHECK(with("trace.transmission = true\noutput.waypoints = 5\n") ==
        "a.toml:3:20: output.waypoints = 5 needs rays that do not split, but with trace.transmission = true they "
        "split at every surface: remove output.waypoints, or set trace.transmission to false");
  CHECK(with("trace.diffraction = true\ntrace.scattering = true\noutput.waypoints = 5\n") == "no error");
  // The place is that of the later of the two keys, or of --set.
  const std::string sphere = "trace.reception = \"sphere\"\n";
  check_contains(with(sphere + "trace.diffraction = true\n"), "a.toml:3:21: trace.reception = \"sphere\" receives");
  check_contains(error_of(scene + sphere + ends, {"trace.diffraction=true"}),
                 "--set trace.diffraction=true: trace.reception = \"sphere\" receives");
  // Every contradiction is reported.
  const std::string both = with("trace.reception = \"sphere\"\n" + all);
  for (const std::string key : {"trace.diffraction", "trace.transmission", "trace.scattering"})
    check_contains(both, key + " = true: set it to false");
}

TEST_CASE("orders by name or mnemonic; launch shapes that contradict them are refused") {
  for (const std::string method : {"none", "WS", "Z", "HZ", "H3DH", "H3DH2DH", "hilbert3d-histogram-hilbert3d", "auto"})
    CHECK(error_of(scene + "order.method = \"" + method + "\"\norder.each_depth = true\n" + ends) == "no error");
  const auto with = [](const std::string& keys) { return error_of(scene + keys + ends); };
  CHECK(with("order.method = \"H3DH\"\nlaunch.shape = \"3d\"\nlaunch.local_size = 64\norder.bin_num = 20\n") ==
        "no error");
  CHECK(with("order.method = \"H3DH3DH\"\nlaunch.shape = \"3d\"\n") == "no error");
  CHECK(with("order.method = \"H3DH2DH\"\nlaunch.shape = \"1d\"\n") ==
        "a.toml:3:16: order.method = \"H3DH2DH\" needs a launch of 2 dimensions, but launch.shape = \"1d\" is set: "
        "remove launch.shape");
  check_contains(with("launch.local_size = 48\n"),
                 "a.toml:2:21: launch.local_size = 48 is not a power of two: give 32");
  check_contains(with("launch.local_size = 2048\n"), "out of range");
  check_contains(with("order.bin_num = 0\n"), "out of range");
  check_contains(with("launch.shape = \"4d\"\n"), "is not a known value");
}

TEST_CASE("--set overrides the file, as TOML or as a bare word") {
  const Config c =
      parse_config(scene + "trace.rays = 5\ntrace.diffraction = true\n" + ends, "/data/a.toml",
                   {"trace.rays=7", "trace.diffraction=false", "trace.directions=fibonacci", "trace.rays=1e3",
                    "scene.file=", "scene.generate=--seed 3", "scene.material_alias.door=wood",
                    "receiver.0.position_m=[1, 2, 3]", "output.directory=\"/o\""});
  CHECK(c.trace.rays == 1000);
  CHECK_FALSE(c.trace.diffraction);
  CHECK(c.trace.directions.word() == "fibonacci");
  CHECK(c.scene.file.empty());
  CHECK(c.scene.generate == "--seed 3");
  CHECK(c.scene.material_alias.at("door") == "wood");
  CHECK(c.receivers[0].position_m == std::array<double, 3>{1, 2, 3});
  CHECK(c.output.directory == "/o");
}

TEST_CASE("mistakes in --set are reported as --set") {
  const auto of = [](const std::string& set) { return error_of(scene + ends, {set}); };
  CHECK(of("trace.ray=5") == "--set trace.ray=5: unknown key \"trace.ray\"; did you mean \"trace.rays\"?");
  check_contains(of("trace.rays=many"), "--set trace.rays=many: trace.rays must be an integer");
  check_contains(of("trace.rays=0"), "--set trace.rays=0: trace.rays = 0 is out of range");
  check_contains(of("trace.rays"), "--set trace.rays: write it as key=value");
  check_contains(of("rays=5"), "did you mean \"trace.rays\"?");
  check_contains(of("receiver.1.name=x"), "the file has 1 [[receiver]]");
  check_contains(of("receiver.name=x"), "write receiver.INDEX.KEY");
  check_contains(of("material=[{name=\"m\"}]"), "to add a [[material]], write it into the file");
  check_contains(of("material=[{name=\"m\"}]"), "material.INDEX.KEY=VALUE, such as material.0.name=");
  check_contains(of("track=[]"), "track.INDEX.KEY=VALUE, such as track.0.");
  check_contains(of("trace={rays=5}"), "trace is a table: set one of its keys, trace.KEY=VALUE");
  CHECK(of("material=[]").find("did you mean") == std::string::npos);
  check_contains(of("receiver.0.position_m=[1, 2"), "--set receiver.0.position_m=[1, 2: ");
  check_contains(of("trace.rays=5\ntrace.seed=1"), "trace.rays must be an integer");
  check_contains(of("trace.max_diffractions=9"), "--set trace.max_diffractions=9: trace.max_diffractions = 9 is out");
}

TEST_CASE("a station stands for a transmitter and a receiver; its name is its own") {
  const std::string station = "[[station]]\nname = \"rsu\"\nposition_m = [0, 0, 6]\n";
  const Config c = parse_config(scene + station +
                                    "antenna = \"dipole\"\npolarization = \"VH\"\norientation_deg = [9, 8, 7]\n"
                                    "velocity_m_s = [1, 2, 3]\n[[station]]\nname = \"b\"\nposition_m = [1, 2, 3]\n",
                                "a.toml", {"station.1.polarization=cross"});
  REQUIRE(c.stations.size() == 2);
  CHECK(c.transmitters.empty());
  CHECK(c.receivers.empty());
  CHECK(c.stations[0].name == "rsu");
  CHECK(c.stations[0].position_m == std::array<double, 3>{0, 0, 6});
  CHECK(c.stations[0].antenna == "dipole");
  CHECK(c.stations[0].polarization.word() == "VH");
  CHECK(c.stations[0].orientation_deg == std::array<double, 3>{9, 8, 7});
  CHECK(c.stations[0].velocity_m_s == std::array<double, 3>{1, 2, 3});
  CHECK(c.stations[1].polarization.word() == "cross");
  CHECK(parse_config(c.text, "b.toml").text == c.text);
  CHECK(c.text.find("[[transmitter]]") == std::string::npos);
  check_contains(error_of(scene + station), "a.toml:2:1: one [[station]] alone has no other end to send to");
  check_contains(error_of(scene + ends + "[[station]]\nname = \"r\"\nposition_m = [0, 0, 0]\n"),
                 "station.name = \"r\" is used twice");
  check_contains(error_of(scene + station + station), "station.name = \"rsu\" is used twice");
  check_contains(error_of(scene + "[[station]]\nname = \"s\"\n"), "[[station]] has no position_m");
  check_contains(error_of(scene + ends + station + "role = \"both\"\n"), "unknown key");
}

TEST_CASE("a file that cannot be read is a config error") {
  CHECK_THROWS_AS(wavetracer::load_config("/nonexistent/a.toml"), ConfigError);
  CHECK_THROWS_AS(wavetracer::load_config("/"), ConfigError);
}
