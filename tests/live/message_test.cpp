// SPDX-License-Identifier: Apache-2.0
// Messages of clients without a socket: which are accepted, and which are refused with which code.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

#include "live/endpoint.hpp"
#include "live/message.hpp"
#include "live/token.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer::live;

namespace {

std::string code_of(const std::string& line, size_t max_vehicles = 4) {
  try {
    parse_message(line, max_vehicles);
  } catch (const ProtocolError& error) {
    return error.code;
  }
  return "";
}

std::string text_of(const std::string& line) {
  try {
    parse_message(line, 4);
  } catch (const ProtocolError& error) {
    return error.what();
  }
  return "";
}

std::string frame(const std::string& vehicles) {
  return R"({"message":"frame","frame":3,"time_s":0.5,"vehicles":[)" + vehicles + "]}";
}

std::string vehicle(const std::string& more) { return R"({"id":"a","type":"passenger",)" + more + "}"; }

Hello hello_of_radar(const std::string& word) {
  return std::get<Hello>(parse_message(R"({"message":"hello","protocol":1,"radar":")" + word + "\"}", 4));
}

}  // namespace

TEST_CASE("hello, frame, at and bye") {
  const auto hello = std::get<Hello>(
      parse_message(R"({"message":"hello","protocol":1,"token":"abc","mode":"free","detail":"vertices",)"
                    R"("encoding":"cbor"})",
                    4));
  CHECK(hello.protocol == 1);
  CHECK(hello.token == "abc");
  CHECK(hello.free_running);
  CHECK(hello.detail == Detail::vertices);
  CHECK(hello.encoding == Encoding::cbor);
  const auto asked = std::get<FrameMessage>(
      parse_message(frame(vehicle(R"("position_m":[1,2.5,-3],"yaw_deg":90,"velocity_m_s":[4,5,6])")), 4));
  CHECK(asked.frame == 3);
  CHECK(asked.time_s == 0.5);
  CHECK(!asked.cold);
  CHECK(!asked.detail);
  REQUIRE(asked.vehicles.size() == 1);
  const wavetracer::LivePose& pose = asked.vehicles[0];
  CHECK(pose.id == "a");
  CHECK(pose.position_m == glm::dvec3(1, 2.5, -3));
  const glm::dvec3 ahead = pose.orientation * glm::dvec3(1, 0, 0);  // a yaw of 90 degrees looks along +y
  CHECK(std::abs(ahead.x) < 1e-15);
  CHECK(ahead.y == doctest::Approx(1));
  CHECK(*pose.velocity_m_s == glm::dvec3(4, 5, 6));
  CHECK(!pose.angular_velocity_rad_s);
  CHECK(!asked.between);
  const auto at =
      std::get<FrameMessage>(parse_message(R"({"message":"at","frame":8,"time_s":0.25,"detail":"paths"})", 4));
  CHECK(at.between);
  CHECK(at.frame == 8);
  CHECK(at.time_s == 0.25);
  CHECK(at.detail == Detail::paths);
  CHECK(at.vehicles.empty());
  CHECK(std::holds_alternative<Bye>(parse_message(R"({"message":"bye"})", 4)));
}

TEST_CASE("a vehicle may say how far it has gone, as a number") {
  const auto asked = std::get<FrameMessage>(
      parse_message(frame(vehicle(R"("position_m":[1,2,3],"yaw_deg":0,"travelled_m":-12.5)")), 4));
  CHECK(asked.vehicles.at(0).travelled_m == -12.5);
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,3],"yaw_deg":0,"travelled_m":[1,0,0])"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,3],"yaw_deg":0,"travelled_m":1e300)"))) == "bad_value");
}

TEST_CASE("radars are asked for in hello, and in a frame or an instant in its place") {
  CHECK(hello_of_radar("detections").radar == RadarDetail::detections);
  CHECK(std::get<Hello>(parse_message(R"({"message":"hello","protocol":1})", 4)).radar == RadarDetail::none);
  const auto at =
      std::get<FrameMessage>(parse_message(R"({"message":"at","frame":8,"time_s":0.25,"radar":"cubes"})", 4));
  CHECK(at.radar == RadarDetail::cubes);
  const auto none = std::get<FrameMessage>(
      parse_message(R"({"message":"frame","frame":8,"time_s":1,"vehicles":[],"radar":"none"})", 4));
  CHECK(none.radar == RadarDetail::none);
  CHECK(code_of(R"({"message":"at","frame":8,"time_s":0.25,"radar":true})") == "bad_value");
  CHECK(text_of(R"({"message":"hello","protocol":1,"radar":"cube"})").find("did you mean \"cubes\"?") !=
        std::string::npos);
}

TEST_CASE("a quaternion is w, x, y, z") {
  const auto asked = std::get<FrameMessage>(
      parse_message(frame(vehicle(R"("position_m":[0,0,0],"orientation":[0.5,0.5,0.5,0.5])")), 4));
  const glm::dvec3 turned = asked.vehicles[0].orientation * glm::dvec3(1, 0, 0);  // 120 degrees about (1, 1, 1)
  CHECK(turned.y == doctest::Approx(1));
}

TEST_CASE("what is no message is refused with its reason") {
  CHECK(code_of("") == "bad_json");
  CHECK(code_of("[]") == "bad_json");
  CHECK(code_of("{") == "bad_json");
  CHECK(code_of("{\"message\":\"\xff\"}") == "bad_json");
  CHECK(code_of(R"({"message":"bye"} x)") == "bad_json");
  CHECK(code_of(R"({"message":"bye","message":"hello"})") == "bad_json");
  CHECK(code_of("{}") == "missing_key");
  CHECK(code_of(R"({"message":7})") == "bad_value");
  CHECK(code_of(R"({"message":"frme"})") == "unknown_message");
  CHECK(text_of(R"({"message":"frme"})").find("did you mean \"frame\"?") != std::string::npos);
  CHECK(code_of(R"({"message":"hello"})") == "missing_key");
  CHECK(code_of(R"({"message":"hello","protocol":-1})") == "bad_value");
  CHECK(code_of(R"({"message":"hello","protocol":1,"mode":"fast"})") == "bad_value");
  CHECK(code_of(R"({"message":"hello","protocol":1,"file":"/etc/passwd"})") == "unknown_key");
  CHECK(text_of(R"({"message":"hello","protocl":1})").find("did you mean \"protocol\"?") != std::string::npos);
}

TEST_CASE("poses that are no poses") {
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,3])"))) == "bad_value");  // no orientation
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,3],"yaw_deg":1,"orientation":[1,0,0,0])"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2],"yaw_deg":1)"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,"3"],"yaw_deg":1)"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,1e300],"yaw_deg":1)"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,1e999],"yaw_deg":1)"))) == "bad_json");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,NaN],"yaw_deg":1)"))) == "bad_json");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,null],"yaw_deg":1)"))) == "bad_value");
  CHECK(code_of(frame(vehicle(R"("position_m":[1,2,3],"yaw":1)"))) == "unknown_key");
  CHECK(code_of(frame(R"({"id":"","type":"a","position_m":[1,2,3],"yaw_deg":1})")) == "bad_value");
  CHECK(code_of(frame(R"({"id":"a\u0000b","type":"a","position_m":[1,2,3],"yaw_deg":1})")) == "bad_value");
  CHECK(code_of(frame(R"({"id":")" + std::string(200, 'a') + R"(","type":"a","position_m":[1,2,3],"yaw_deg":1})")) ==
        "bad_value");
  CHECK(code_of(frame("1,2,3,4,5")) == "no_place");
  CHECK(code_of(R"({"message":"frame","frame":1.5,"time_s":0,"vehicles":[]})") == "bad_value");
  CHECK(code_of(R"({"message":"frame","frame":9007199254740992,"time_s":0,"vehicles":[]})") == "bad_value");
  CHECK(code_of(R"({"message":"frame","frame":1,"time_s":0,"vehicles":{}})") == "bad_value");
}

TEST_CASE("a refused frame keeps its number") {
  try {
    parse_message(frame("7"), 4);
    FAIL("accepted");
  } catch (const ProtocolError& error) {
    CHECK(error.frame == 3);
  }
}

TEST_CASE("depth is bounded before anything is built") {
  for (const char bracket : {'[', '{'}) {
    std::string deep = R"({"message":)";
    for (int k = 0; k < 200000; ++k) deep += bracket == '[' ? "[" : "{\"a\":";
    CHECK(code_of(deep) == "bad_json");
    CHECK(text_of(deep).find("nested deeper") != std::string::npos);
  }
}

TEST_CASE("what no message has is refused where it begins to be too much, and a frame keeps its number") {
  const auto many = [](const std::string& one, int count) {
    std::string out = one;
    for (int k = 1; k < count; ++k) out += "," + one;
    return out;
  };
  // Every text ends in invalid JSON: a parser that reads to the end would report bad_json.
  try {
    parse_message(R"({"message":"frame","frame":3,"vehicles":[)" + many("{}", 5) + "!", 4);
    FAIL("accepted");
  } catch (const ProtocolError& error) {
    CHECK(error.code == "no_place");
    CHECK(error.frame == 3);
  }
  CHECK(code_of(R"({"message":"frame","frame":3,"vehicles":[)" + many("{}", 4) + "!") == "bad_json");
  for (const char* const begin : {R"({"message":[)", R"({"message":{)", R"({"vehicles":[{"position_m":[)", "[", "{"}) {
    CAPTURE(begin);
    const std::string where = begin;
    std::string text = where;
    for (int k = 0; k < 17; ++k) text += (k ? "," : "") + (where.back() == '{' ? fmt::format("\"{}\":1", k) : "1");
    CHECK(text_of(text + "!").find("more than 16 entries") != std::string::npos);
  }
  CHECK(code_of(frame(many(vehicle(R"("position_m":[1,2,3],"yaw_deg":4)"), 4))) == "");
}

TEST_CASE("a long message is read whole, and what is broken behind its frame has no number") {
  std::string vehicles;
  constexpr size_t count = 10000;
  for (size_t i = 0; i < count; ++i)
    vehicles +=
        fmt::format(R"({}{{"id":"v{}","type":"bus","position_m":[{},0,1e1],"yaw_deg":0,"velocity_m_s":[-1,0,0]}})",
                    i > 0 ? "," : "", i, i);
  const auto asked = std::get<FrameMessage>(parse_message(frame(vehicles), count));
  REQUIRE(asked.vehicles.size() == count);
  size_t wrong = 0;
  for (size_t i = 0; i < count; ++i) {
    const wavetracer::LivePose& pose = asked.vehicles[i];
    wrong += pose.id != fmt::format("v{}", i) || pose.position_m != glm::dvec3(static_cast<double>(i), 0, 10) ||
             *pose.velocity_m_s != glm::dvec3(-1, 0, 0);
  }
  CHECK(wrong == 0);
  CHECK(code_of(frame(vehicles), count - 1) == "no_place");
  try {
    parse_message(frame(vehicles) + "]", count);
    FAIL("accepted");
  } catch (const ProtocolError& error) {
    CHECK(error.code == "bad_json");
    CHECK_FALSE(error.frame.has_value());
  }
}

TEST_CASE("mutations of a message are read or refused, nothing else") {
  const std::string good = frame(vehicle(R"("position_m":[1,2.5,-3e0],"yaw_deg":90,"velocity_m_s":[4,5,6])"));
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::string line = good;
    for (int k = 0; k < 3; ++k) {
      const size_t at = random() % line.size();
      switch (random() % 3) {
        case 0:
          line[at] = static_cast<char>(random());
          break;
        case 1:
          line.erase(at, random() % 8);
          break;
        default:
          line.insert(at, line.substr(random() % line.size(), random() % 16));
      }
      if (line.empty()) line = "{";
    }
    try {
      parse_message(line, 4);
    } catch (const ProtocolError& error) {
      CHECK(!error.code.empty());
    }
  }
}

TEST_CASE("endpoints") {
  using wavetracer::ConfigError;
  CHECK(parse_endpoint("unix:/tmp/a.sock").path == "/tmp/a.sock");
  CHECK(parse_endpoint("tcp:127.0.0.1:7710").loopback);
  CHECK(parse_endpoint("tcp:127.9.9.9:0").loopback);
  CHECK(parse_endpoint("tcp:[::1]:7710").loopback);
  CHECK(parse_endpoint("tcp:localhost:7710").loopback);
  CHECK(!parse_endpoint("tcp:0.0.0.0:7710").loopback);
  CHECK(!parse_endpoint("tcp:[::]:7710").loopback);
  CHECK(!parse_endpoint("tcp:127.0.0.1:7710").datagrams);
  CHECK(parse_endpoint("udp:127.0.0.1:8103").datagrams);
  CHECK(!parse_endpoint("udp:0.0.0.0:8103").loopback);
  for (const char* wrong : {"", "tcp:", "tcp:127.0.0.1", "tcp:127.0.0.1:", "tcp:127.0.0.1:65536", "tcp:127.0.0.1:-1",
                            "tcp:example.org:80", "udp:127.0.0.1", "sctp:127.0.0.1:1", "unix:", "127.0.0.1:80"})
    CHECK_THROWS_AS(parse_endpoint(wrong), ConfigError);
  CHECK_THROWS_AS(parse_endpoint("unix:/" + std::string(200, 'a')), ConfigError);
}

TEST_CASE("tokens") {
  CHECK(same_token("abcdefghijklmnop", "abcdefghijklmnop"));
  for (const char* other : {"", "a", "abcdefghijklmnoq", "abcdefghijklmno", "abcdefghijklmnopabcdefghijklmnop"})
    CHECK(!same_token("abcdefghijklmnop", other));
}
