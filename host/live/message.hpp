// SPDX-License-Identifier: Apache-2.0
// Parses messages of clients: one line of JSON becomes a checked struct; docs/live.md has the schema.
// The text is not trusted: anything that is no message of the protocol throws.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wavetracer/live.hpp"

namespace wavetracer::live {

inline constexpr uint64_t protocol_version = 1;

enum class Detail { links, paths, vertices };
// The encoding of channels in an answer: in its line, or as columns in bytes that follow it (live/channel_columns.hpp).
enum class Encoding { json, cbor };

// Answers say nothing of the radars of the configuration, or give their detections, or their cubes, too.
enum class RadarDetail { none, detections, cubes };

struct Hello {
  uint64_t protocol = 0;
  std::string token;
  bool free_running = false;  // "mode": "free"
  Detail detail = Detail::links;
  Encoding encoding = Encoding::json;
  RadarDetail radar = RadarDetail::none;
};

struct FrameMessage {
  uint64_t frame = 0;  // the client's own number, which the answer repeats
  double time_s = 0;
  std::vector<LivePose> vehicles;
  bool cold = false;     // forget the results of earlier frames
  bool between = false;  // "at": the frame has no poses, but a time between those of the last two frames
  // They replace those of hello.
  std::optional<Detail> detail;
  std::optional<RadarDetail> radar = {};
};

struct Bye {};

using Message = std::variant<Hello, FrameMessage, Bye>;

// A refused message: its code and text are sent to the client.
struct ProtocolError : std::runtime_error {
  std::string code;
  std::optional<uint64_t> frame;  // the number of a frame message, if known
  ProtocolError(std::string error_code, const std::string& text)
      : std::runtime_error(text), code(std::move(error_code)) {}
};

// line: without its newline. max_vehicles: in one frame. Throws ProtocolError and nothing else except std::bad_alloc;
// memory is proportional to the length of the line.
Message parse_message(std::string_view line, size_t max_vehicles);

}  // namespace wavetracer::live
