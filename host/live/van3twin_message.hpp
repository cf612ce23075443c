// SPDX-License-Identifier: Apache-2.0
// The datagrams of VaN3Twin: its ns-3 modules send places of vehicles and ask for channels between two of them, a text
// of ASCII in each datagram. docs/live.md lists them. The text is not trusted.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace wavetracer::live::van3twin {

// The longest datagram, as that of VaN3Twin's own server. Longer ones are no messages.
inline constexpr size_t most_bytes = 1024;
// The longest id: its clients have 100 bytes for an answer, which repeats the id.
inline constexpr size_t most_id_bytes = 64;

struct LocationUpdate {
  std::string id;
  glm::dvec3 position_m{0};  // in the sender's coordinates
  double bearing_deg = 0;    // clockwise from the axis y, as SUMO has it
};
enum class Figure { path_gain, delay, los };
struct Question {
  Figure figure = Figure::path_gain;
  std::string from, to;  // ids; empty or "0": a node that is at the origin because it takes no part yet
};
struct Shutdown {};
using Message = std::variant<LocationUpdate, Question, Shutdown>;

// Returns none if this is no message of the protocol.
std::optional<Message> parse(std::string_view datagram);

// Figures of a link. Without a path the gain is -inf.
struct Link {
  double gain_db = -std::numeric_limits<double>::infinity();
  double first_delay_s = 0;  // the delay of the path that arrives first
  bool los = false;
};

// True if one end of the question is at the origin. Its answer is zero.
bool is_about_origin(const Question& question);
std::string confirmation(const LocationUpdate& update);
// The answer about a link, or about the origin if there is none. "Path gain" is a loss in dB, 300 without a path.
std::string answer(const Question& question, const std::optional<Link>& link);

}  // namespace wavetracer::live::van3twin
