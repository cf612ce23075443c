// SPDX-License-Identifier: Apache-2.0
// Every object is read by a list of its keys, so that an unknown key is refused with the nearest name.
#include "live/message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/spelling.hpp"
#include "live/message_json.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer::live {
namespace {

using nlohmann::json;

constexpr size_t max_id_bytes = 128;  // limit of ids and types
constexpr size_t max_token_bytes = 4096;
constexpr double max_coordinate_m = 1e7, max_time_s = 1e12, max_speed = 1e6, max_travelled_m = 1e12;

// The keys of one object; each is read by name.
class Object {
 public:
  Object(const json& value, std::string where, std::vector<std::string> known)
      : value_(value), where_(std::move(where)) {
    if (!value.is_object()) refuse("bad_value", where_ + " must be an object");
    for (const auto& [key, ignored] : value.items())
      if (std::ranges::find(known, key) == known.end())
        refuse("unknown_key", fmt::format("{}: {} is an unknown key{}", where_, in_quotes(key),
                                          key.size() <= max_quoted_bytes ? spelling_hint(key, known) : ""));
  }

  bool has(const char* key) const { return value_.contains(key); }
  const json& at(const char* key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) refuse("missing_key", fmt::format("{}: \"{}\" is missing", where_, key));
    return *found;
  }
  std::string text(const char* key, size_t max_bytes) const {
    const json& v = at(key);
    if (!v.is_string()) refuse("bad_value", name(key) + " must be a string");
    const auto& out = v.get_ref<const std::string&>();
    if (out.size() > max_bytes) refuse("bad_value", fmt::format("{} has more than {} bytes", name(key), max_bytes));
    return out;
  }
  // Returns a text that names something: not empty, without control characters.
  std::string id(const char* key) const {
    std::string out = text(key, max_id_bytes);
    if (out.empty()) refuse("bad_value", name(key) + " is empty");
    if (has_control_character(out)) refuse("bad_value", name(key) + " contains control characters");
    return out;
  }
  bool flag(const char* key) const {
    if (!has(key)) return false;
    if (!at(key).is_boolean()) refuse("bad_value", name(key) + " must be true or false");
    return at(key).get<bool>();
  }
  uint64_t count(const char* key, uint64_t most) const {
    const json& v = at(key);
    if (!v.is_number_unsigned() || v.get<uint64_t>() > most)
      refuse("bad_value", fmt::format("{} must be an integer from 0 to {}", name(key), most));
    return v.get<uint64_t>();
  }
  double number(const char* key, double most) const { return number(at(key), name(key), most); }
  template <size_t N>
  std::array<double, N> numbers(const char* key, double most) const {
    const json& v = at(key);
    if (!v.is_array() || v.size() != N)
      refuse("bad_value", fmt::format("{} must be an array of {} numbers", name(key), N));
    std::array<double, N> out;
    for (size_t i = 0; i < N; ++i) out[i] = number(v[i], name(key), most);
    return out;
  }
  glm::dvec3 vector(const char* key, double most) const {
    const auto [x, y, z] = numbers<3>(key, most);
    return {x, y, z};
  }
  // Returns the index of the word among the choices.
  size_t choice(const char* key, const std::vector<std::string>& choices) const {
    const std::string word = text(key, max_id_bytes);
    const auto found = std::ranges::find(choices, word);
    if (found == choices.end())
      refuse("bad_value", fmt::format("{} is {}, but must be one of {}{}", name(key), in_quotes(word),
                                      fmt::join(choices, ", "), spelling_hint(word, choices)));
    return static_cast<size_t>(found - choices.begin());
  }

 private:
  std::string name(const char* key) const { return fmt::format("{}: \"{}\"", where_, key); }
  static double number(const json& v, const std::string& name, double most) {
    if (!v.is_number()) refuse("bad_value", name + " must be a number");
    const double out = v.get<double>();
    if (!(std::abs(out) <= most))
      refuse("bad_value", fmt::format("{} is {}, but its absolute value must be at most {}", name, out, most));
    return out;
  }

  const json& value_;
  std::string where_;
};

Detail detail_of(const Object& object) {
  return static_cast<Detail>(object.choice("detail", {"links", "paths", "vertices"}));
}

RadarDetail radar_of(const Object& object) {
  return static_cast<RadarDetail>(object.choice("radar", {"none", "detections", "cubes"}));
}

Hello hello_of(const json& value) {
  const Object object(value, "hello", {"message", "protocol", "token", "mode", "detail", "encoding", "radar"});
  Hello out;
  out.protocol = object.count("protocol", max_frame);
  if (object.has("token")) out.token = object.text("token", max_token_bytes);
  if (object.has("mode")) out.free_running = object.choice("mode", {"step", "free"}) == 1;
  if (object.has("detail")) out.detail = detail_of(object);
  if (object.has("encoding")) out.encoding = static_cast<Encoding>(object.choice("encoding", {"json", "cbor"}));
  if (object.has("radar")) out.radar = radar_of(object);
  return out;
}

// Yaw is treated as in trajectories, so that the same angle gives the same bits.
glm::dquat orientation_of(const Object& vehicle) {
  if (vehicle.has("yaw_deg") == vehicle.has("orientation"))
    refuse("bad_value", "vehicle: give either \"yaw_deg\" or \"orientation\"");
  if (vehicle.has("orientation")) {
    const auto [w, x, y, z] = vehicle.numbers<4>("orientation", 2);
    return {w, x, y, z};
  }
  const double yaw_rad = vehicle.number("yaw_deg", 1e6) * (std::numbers::pi / 180);
  return {std::cos(yaw_rad / 2), 0, 0, std::sin(yaw_rad / 2)};
}

LivePose pose_of(const json& value) {
  const Object vehicle(
      value, "vehicle",
      {"id", "type", "position_m", "yaw_deg", "orientation", "velocity_m_s", "angular_velocity_rad_s", "travelled_m"});
  LivePose out{.id = vehicle.id("id"),
               .type = vehicle.id("type"),
               .position_m = vehicle.vector("position_m", max_coordinate_m),
               .orientation = orientation_of(vehicle),
               .velocity_m_s = {},
               .angular_velocity_rad_s = {}};
  if (vehicle.has("velocity_m_s")) out.velocity_m_s = vehicle.vector("velocity_m_s", max_speed);
  if (vehicle.has("angular_velocity_rad_s"))
    out.angular_velocity_rad_s = vehicle.vector("angular_velocity_rad_s", max_speed);
  if (vehicle.has("travelled_m")) out.travelled_m = vehicle.number("travelled_m", max_travelled_m);
  return out;
}

FrameMessage frame_of(const json& value) {
  const Object object(value, "frame", {"message", "frame", "time_s", "vehicles", "cold", "detail", "radar"});
  FrameMessage out;
  out.frame = object.count("frame", max_frame);
  try {
    out.time_s = object.number("time_s", max_time_s);
    out.cold = object.flag("cold");
    if (object.has("detail")) out.detail = detail_of(object);
    if (object.has("radar")) out.radar = radar_of(object);
    const json& vehicles = object.at("vehicles");
    if (!vehicles.is_array()) refuse("bad_value", "frame: \"vehicles\" must be an array");
    for (const json& vehicle : vehicles) out.vehicles.push_back(pose_of(vehicle));
  } catch (ProtocolError& error) {
    error.frame = out.frame;
    throw;
  }
  return out;
}

FrameMessage instant_of(const json& value) {
  const Object object(value, "at", {"message", "frame", "time_s", "detail", "radar"});
  FrameMessage out;
  out.between = true;
  out.frame = object.count("frame", max_frame);
  try {
    out.time_s = object.number("time_s", max_time_s);
    if (object.has("detail")) out.detail = detail_of(object);
    if (object.has("radar")) out.radar = radar_of(object);
  } catch (ProtocolError& error) {
    error.frame = out.frame;
    throw;
  }
  return out;
}

}  // namespace

Message parse_message(std::string_view line, size_t max_vehicles) {
  const json value = read_message_json(line, max_vehicles);
  if (!value.is_object()) refuse("bad_json", "a message must be an object, {\"message\": ...}");
  const auto kind = value.find("message");
  if (kind == value.end())
    refuse("missing_key", "\"message\" is missing: give \"hello\", \"frame\", \"at\" or \"bye\"");
  if (!kind->is_string()) refuse("bad_value", "\"message\" must be a string");
  const auto& name = kind->get_ref<const std::string&>();
  if (name == "hello") return hello_of(value);
  if (name == "frame") return frame_of(value);
  if (name == "at") return instant_of(value);
  if (name == "bye") {
    Object(value, "bye", {"message"});
    return Bye{};
  }
  refuse("unknown_message",
         in_quotes(name) + " must be one of hello, frame, at, bye" +
             (name.size() <= max_quoted_bytes ? spelling_hint(name, {"hello", "frame", "at", "bye"}) : ""));
}

}  // namespace wavetracer::live
