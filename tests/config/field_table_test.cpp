// SPDX-License-Identifier: Apache-2.0
// The field table and what is made of it: the contract's keys, init, help, the resolved config, spelling hints. It does
// not use the parser's internals: texts go in, Configs and texts come out.
#include "config/field_table.hpp"
#include <doctest/doctest.h>
#include <random>
#include <set>
#include "base/spelling.hpp"
#include "config/field_table.hpp"
#include "config/reference.hpp"
#include "config/texts.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::ends;

TEST_CASE("every key of the contract is in the table, once") {
  std::set<std::string> keys;
  for (const auto& table : config::tables())
    for (const auto& field : table.fields) {
      CAPTURE(field.name);
      CHECK(keys.insert(table.name + "." + field.name).second);
      CHECK_FALSE(field.doc.empty());
    }
  for (const char* key : {"scene.file",
                          "scene.generate",
                          "radio.frequency_hz",
                          "transmitter.name",
                          "transmitter.position_m",
                          "transmitter.antenna",
                          "transmitter.polarization",
                          "transmitter.orientation_deg",
                          "transmitter.velocity_m_s",
                          "receiver.name",
                          "receiver.position_m",
                          "receiver.antenna",
                          "receiver.polarization",
                          "receiver.orientation_deg",
                          "receiver.velocity_m_s",
                          "trace.batch_receivers",
                          "station.name",
                          "station.position_m",
                          "station.antenna",
                          "station.polarization",
                          "station.orientation_deg",
                          "station.velocity_m_s",
                          "scene.itu_edition",
                          "scene.extrapolate_materials",
                          "material.library",
                          "trajectories.file",
                          "trajectories.generate",
                          "trajectories.offset_m",
                          "trajectories.scale",
                          "trajectories.persons",
                          "trajectories.containers",
                          "trajectories.default_type",
                          "track.id",
                          "track.type",
                          "track.waypoints",
                          "vehicle_type.name",
                          "vehicle_type.model",
                          "vehicle_type.length_m",
                          "vehicle_type.width_m",
                          "vehicle_type.height_m",
                          "vehicle_type.material",
                          "mount.name",
                          "mount.on",
                          "mount.role",
                          "mount.offset_m",
                          "mount.antenna",
                          "mount.polarization",
                          "mount.orientation_deg",
                          "links.max_distance_m",
                          "links.transmitters",
                          "links.receivers",
                          "links.v2v",
                          "links.v2i",
                          "links.i2i",
                          "links.same_vehicle",
                          "time.start_s",
                          "time.end_s",
                          "time.step_s",
                          "trace.recall",
                          "trace.max_rays",
                          "trace.reuse",
                          "trace.refresh_rays",
                          "trace.discover_every_s",
                          "trace.discovery",
                          "trace.forget_frames",
                          "output.shard_frames",
                          "trace.rays",
                          "trace.max_depth",
                          "trace.floor_db",
                          "trace.reflection",
                          "trace.diffraction",
                          "trace.transmission",
                          "trace.scattering",
                          "trace.directions",
                          "trace.reception",
                          "trace.sphere_radius_m",
                          "trace.seed",
                          "order.method",
                          "order.each_depth",
                          "order.bin_num",
                          "launch.shape",
                          "launch.local_size",
                          "cache.kind",
                          "cache.key",
                          "cache.hash_method",
                          "cache.division",
                          "cache.buffer_size",
                          "cache.load_factor",
                          "cache.locking",
                          "cache.readers_number",
                          "cache.purge",
                          "cache.position_step_m",
                          "cache.residual_value",
                          "cache.scope",
                          "cache.hit_point",
                          "cache.first_depth",
                          "cache.statistics",
                          "output.directory",
                          "output.waypoints",
                          "output.cache_entries"}) {
    CAPTURE(key);
    CHECK(keys.contains(key));
  }
}

TEST_CASE("each slot is a member of its own") {
  Config c = config::prototype();
  const auto address = []<class T>(const T& slot) -> const void* {
    if constexpr (std::is_same_v<T, config::ChoiceSlot>)
      return slot.chosen;
    else
      return slot;
  };
  std::set<const void*> members;
  for (const auto& table : config::tables())
    for (const auto& field : table.fields) CHECK(members.insert(std::visit(address, field.slot(c, 0))).second);
}

TEST_CASE("the commented config of init parses, holds every key and keeps the defaults") {
  const std::string text = commented_config();
  const Config c = parse_config(text, "example.toml");
  for (const auto& table : config::tables())
    for (const auto& field : table.fields) {
      CAPTURE(field.name);
      const bool on = text.find("\n" + field.name + " = ") != std::string::npos;
      const bool off = text.find("\n# " + field.name + " = ") != std::string::npos;
      CHECK((on || off));
    }
  CHECK_FALSE(c.scene.generate.empty());
  CHECK(c.transmitters.size() == 1);
  CHECK(c.receivers.size() == 1);
  Config filled = c, defaults = config::prototype();
  for (const auto& table : config::tables()) {
    if (table.append || table.name == "scene" || table.name == "output") continue;
    for (const auto& field : table.fields)
      CHECK(config::literal(field, field.slot(filled, 0)) == config::literal(field, field.slot(defaults, 0)));
  }
  for (size_t start = 0; start < text.size();) {
    const size_t end = text.find('\n', start);
    CHECK(end - start <= 120);
    start = end + 1;
  }
}

TEST_CASE("help names every key with its default") {
  const std::string help = field_help();
  CHECK(help.find("trace.rays") != std::string::npos);
  CHECK(help.find("default 1000000") != std::string::npos);
  CHECK(help.find("cache.residual_value") != std::string::npos);
  CHECK(help.find("trace.diffraction") != std::string::npos);
}

TEST_CASE("the resolved config reads back the same, odd characters included") {
  const Config c = parse_config(
      "scene.file = \"a \\\"b\\\"\\\\ \\u0001\\u00e4.xml\"\nradio.frequency_hz = 5912345678.125\n"
      "trace.rays = 1234567890\n"
      "scene.material_alias.\"x.y\" = \"wood\"\n[[material]]\nname = \"m\"\nthickness_m = inf\nb = -0.1\n"
      "[[transmitter]]\nname = \"t\"\nposition_m = [691234.123456789, 5334567.1, -0.0]\n"
      "[[receiver]]\nname = \"r 1\"\nposition_m = [1e-300, 0, 0.1]\n",
      "/data/a.toml");
  const Config d = parse_config(c.text, "/elsewhere/b.toml");
  CHECK(d.text == c.text);
  CHECK(d.scene.file == c.scene.file);
  CHECK(d.scene.material_alias == c.scene.material_alias);
  CHECK(d.transmitters[0].position_m == c.transmitters[0].position_m);
  CHECK(d.radio.frequency_hz == c.radio.frequency_hz);
  CHECK(*d.materials[0].b == *c.materials[0].b);
}

TEST_CASE("edit distances of known pairs") {
  using wavetracer::edit_distance;
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("rays", "rays") == 0);
  CHECK(edit_distance("dpeth", "depth") == 1);  // one swap of neighbours
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("abc", "abcdefgh", 4) == 4);  // given up
  std::mt19937 random(1);
  const auto word = [&] {
    std::string text(random() % 9, 'a');
    for (char& c : text) c = static_cast<char>('a' + random() % 3);
    return text;
  };
  for (int i = 0; i < 20000; ++i) {
    const std::string a = word(), b = word();
    const size_t limit = random() % 8;
    CHECK(edit_distance(a, b, limit) == std::min(edit_distance(a, b), limit));
  }
}

TEST_CASE("a hint needs a near word") {
  const std::vector<std::string> known = {"trace.rays", "trace.seed"};
  CHECK(nearest_word("trace.ray", known) == "trace.rays");
  CHECK(nearest_word("seed", known) == "trace.seed");
  CHECK(nearest_word("wavelength", known).empty());
  CHECK(nearest_word(std::string(size_t{16} << 20, 's'), known).empty());  // no table of its size
  CHECK(spelling_hint("xyz", known).empty());
}

TEST_CASE("a transmitter launches at most 2^31 rays") {
  CHECK(parse_config("scene.file = \"/s.xml\"\ntrace.rays = 2147483648\n" + ends, "a.toml").trace.rays == 2147483648);
  CHECK_THROWS_AS(parse_config("scene.file = \"/s.xml\"\ntrace.rays = 2147483649\n" + ends, "a.toml"), ConfigError);
}
