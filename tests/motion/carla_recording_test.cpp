// SPDX-License-Identifier: Apache-2.0
// Recordings of CARLA as its server writes them, byte by byte as in recordings of CARLA 0.9.12 (those of
// ScenarioRunner's metrics): the same tracks as the text of the same recording, all digits of times, and damaged files.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "motion/readers.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

template <class T>
std::string bytes_of(T value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

std::string text_of(const std::string& text) { return bytes_of(static_cast<uint16_t>(text.size())) + text; }

std::string floats_of(std::initializer_list<float> values) {
  std::string out;
  for (const float value : values) out += bytes_of(value);
  return out;
}

std::string packet_bytes(uint8_t kind, const std::string& data) {
  return bytes_of(kind) + bytes_of(static_cast<uint32_t>(data.size())) + data;
}

std::string packet_of(uint8_t kind, std::initializer_list<std::string> all) {
  std::string data = bytes_of(static_cast<uint16_t>(all.size()));
  for (const std::string& one : all) data += one;
  return packet_bytes(kind, data);
}

std::string numbers_of(uint32_t number, std::initializer_list<float> values) {
  return bytes_of(number) + floats_of(values);
}

std::string start_of(uint64_t frame, double time_s) {
  return packet_bytes(0, bytes_of(frame) + bytes_of(0.05) + bytes_of(time_s));
}

using Attributes = std::initializer_list<std::pair<std::string, std::string>>;

std::string actor_of(uint32_t number, uint8_t type, const std::string& blueprint, const Attributes& attributes) {
  std::string out = bytes_of(number) + bytes_of(type) + floats_of({0, 0, 0, 0, 0, 0}) + bytes_of(uint32_t{26}) +
                    text_of(blueprint) + bytes_of(static_cast<uint16_t>(attributes.size()));
  for (const auto& [key, value] : attributes) out += bytes_of(uint8_t{3}) + text_of(key) + text_of(value);
  return out;
}

const std::string recorder_head =
    bytes_of(uint16_t{1}) + text_of("CARLA_RECORDER") + bytes_of(int64_t{1637676528}) + text_of("Town01");
const std::string recorded_actors = packet_of(
    2, {actor_of(1, 0, "spectator", {}),
        actor_of(174, 1, "vehicle.lincoln.mkz_2017",
                 {{"generation", "1"}, {"number_of_wheels", "4"}, {"object_type", ""}, {"role_name", "hero"}}),
        actor_of(175, 1, "vehicle.harley-davidson.low_rider", {{"number_of_wheels", "2"}}),
        actor_of(176, 5, "sensor.other.collision", {{"role_name", "front"}}),
        actor_of(177, 2, "walker.pedestrian.0001", {})});
const float none = std::numeric_limits<float>::quiet_NaN();
const std::string recorded_boxes =
    packet_of(13, {numbers_of(1, {none, none, none, none, none, none}), numbers_of(174, {10, 20, 80, 193, 95, 92}),
                   numbers_of(176, {none, none, none, none, none, none})});
const std::string first_frame =
    start_of(1, 0) + recorded_actors + packet_of(3, {}) +
    packet_of(4, {bytes_of(uint32_t{176}) + bytes_of(uint32_t{174})}) +
    packet_of(6, {numbers_of(1, {542.5, 4236.75, 490.5, 0, 0, -131.75}), numbers_of(174, {1000, 500, 10, 0, 2, 90}),
                  numbers_of(175, {0, -300, 0, 0, 0, 180}), numbers_of(177, {100, 200, 93, 0, 0, 0})}) +
    packet_bytes(7, "anything") + recorded_boxes + packet_bytes(1, "");

const Track& recorded_track(const Trajectories& all, const std::string& id) {
  const auto found = std::ranges::find(all.tracks, id, &Track::id);
  REQUIRE(found != all.tracks.end());
  return *found;
}

}  // namespace

TEST_CASE("a recording of CARLA's server has the tracks of its text") {
  const std::string again =
      start_of(2, 0.0625) + packet_of(6, {numbers_of(174, {1000, 550, 10, 0, 2, 90})}) + packet_bytes(1, "");
  const Trajectories binary = read_text(recorder_head + first_frame + again, {}, "drive.log");
  const std::string text =
      "Version: 1\nMap: Town01\nDate: 11/23/21 14:08:48\n\nFrame 1 at 0 seconds\n"
      " Create 1: spectator (0) at (0, 0, 0)\n Create 174: vehicle.lincoln.mkz_2017 (1) at (0, 0, 0)\n"
      "  number_of_wheels = 4\n  role_name = hero\n Create 175: vehicle.harley-davidson.low_rider (1) at (0, 0, 0)\n"
      "  number_of_wheels = 2\n Create 177: walker.pedestrian.0001 (2) at (0, 0, 0)\n Positions: 4\n"
      "  Id: 1 Location: (542.5, 4236.75, 490.5) Rotation: (0, 0, -131.75)\n"
      "  Id: 174 Location: (1000, 500, 10) Rotation: (0, 2, 90)\n  Id: 175 Location: (0, -300, 0) Rotation: (0, 0, 180)\n"
      "  Id: 177 Location: (100, 200, 93) Rotation: (0, 0, 0)\n Actor bounding recorded_boxes: 1\n"
      "  Id: 174 origin: (10, 20, 80) extension: (193, 95, 92)\nFrame 2 at 0.0625 seconds\n Positions: 1\n"
      "  Id: 174 Location: (1000, 550, 10) Rotation: (0, 2, 90)\n\nFrames: 2\nDuration: 0.0625 seconds\n";
  const Trajectories expected = read_text(text, {}, "drive.log");
  REQUIRE(binary.tracks.size() == 3);
  REQUIRE(expected.tracks.size() == 3);
  CHECK(recorded_track(binary, "hero").samples.size() == 2);
  for (size_t k = 0; k < 3; ++k) {
    const Track &a = binary.tracks[k], &b = expected.tracks[k];
    CHECK(a.id == b.id);
    CHECK(binary.types[a.type].name == expected.types[b.type].name);
    CHECK(binary.types[a.type].length_m == expected.types[b.type].length_m);
    REQUIRE(a.samples.size() == b.samples.size());
    for (size_t i = 0; i < a.samples.size(); ++i) {
      check_near(a.samples[i].position_m, b.samples[i].position_m);
      check_near(a.samples[i].velocity_m_s, b.samples[i].velocity_m_s);
      CHECK(a.samples[i].time_s == b.samples[i].time_s);
      CHECK(a.samples[i].yaw_rad == b.samples[i].yaw_rad);
      CHECK(a.samples[i].pitch_rad == b.samples[i].pitch_rad);
    }
  }
  REQUIRE(binary.warnings.size() == 1);
  check_contains(binary.warnings[0], "2 samples are of actors without a bounding box");
}

TEST_CASE("long recordings of CARLA's server: times that the text would round to one") {
  const auto at = [](uint64_t frame, double time_s) {
    return start_of(frame, time_s) + packet_of(6, {numbers_of(174, {static_cast<float>(frame), 0, 0, 0, 0, 0})});
  };
  const Trajectories t =
      read_text(recorder_head + first_frame + at(2, 12345.671) + at(3, 12345.674) + at(4, 12345.677), {}, "drive.log");
  REQUIRE(recorded_track(t, "hero").samples.size() == 4);
  CHECK(recorded_track(t, "hero").samples[3].time_s == 12345.677);
}

TEST_CASE("steps of a recording of CARLA vary: a vehicle is absent in frames without it, and jumps still cut") {
  const auto at = [](uint64_t frame, double time_s, float x) {
    return start_of(frame, time_s) + packet_of(6, {numbers_of(174, {x, 500, 10, 0, 2, 90})});
  };
  const std::string varied = at(2, 0.016, 1010) + at(3, 0.032, 1020) + at(4, 0.048, 1030) + at(5, 0.172, 1100);
  CHECK(recorded_track(read_text(recorder_head + first_frame + varied, {}, "drive.log"), "hero").segments.size() == 1);
  const std::string absent = varied + start_of(6, 0.188) + at(7, 0.204, 1120);
  CHECK(recorded_track(read_text(recorder_head + first_frame + absent, {}, "drive.log"), "hero").segments ==
        std::vector<uint32_t>{0, 5});
  const std::string jump = varied + at(6, 0.188, 60000);
  CHECK(recorded_track(read_text(recorder_head + first_frame + jump, {}, "drive.log"), "hero").segments ==
        std::vector<uint32_t>{0, 5});
}

TEST_CASE("a recording of CARLA that ends early has its whole packets, and says so") {
  const std::string all =
      recorder_head + first_frame + start_of(2, 0.05) + packet_of(6, {numbers_of(174, {1000, 550, 10, 0, 0, 90})});
  const Trajectories t = read_text(all.substr(0, all.size() - 3), {}, "drive.log");
  CHECK(recorded_track(t, "hero").samples.size() == 1);
  check_contains(t.warnings[0], "the recording ends inside of a packet of frame 2");
}

TEST_CASE("what is wrong with a recording of CARLA's server is said with its frame") {
  const auto check = [](const std::string& content, const char* text) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(read_text(content, {}, "drive.log"), Contains(text), InputError);
  };
  check(recorder_head.substr(0, recorder_head.size() - 2), "ends inside of its header");
  check(recorder_head, "no positions of vehicles");
  check(recorder_head + first_frame + start_of(2, 0), "frame 2 is at 0 s, as the frame ahead of it");
  check(recorder_head + first_frame + start_of(2, -1), "frame 2 is at -1 s, before the frame ahead of it");
  check(recorder_head + first_frame + start_of(2, none), "frame 2 is at nan s");
  check(recorder_head + first_frame + start_of(2, 1) + packet_of(6, {numbers_of(174, {1, 2, 3, 0, none, 0})}),
        "frame 2 has a position of actor 174 that is not finite");
  check(recorder_head + first_frame + packet_bytes(6, bytes_of(uint16_t{2}) + numbers_of(174, {0, 0, 0, 0, 0, 0})),
        "has a packet of kind 6 with 30 bytes, which are not those of its entries");
  check(recorder_head + first_frame + packet_bytes(6, bytes_of(uint16_t{0}) + "more"),
        "has a packet of kind 6 with 6 bytes");
  check(recorder_head + recorded_actors + packet_of(6, {numbers_of(174, {0, 0, 0, 0, 0, 0})}),
        "has positions, but no frame has begun");
  check(recorder_head + first_frame + bytes_of(uint8_t{6}) + bytes_of(uint32_t{1} << 31),
        "has a packet of 2147483648 bytes");
}
