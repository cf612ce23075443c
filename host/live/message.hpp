// Messages of clients: one line of JSON in, a checked struct out; docs/live.md is the schema.
// Assumes nothing of the text: what is not a message of the protocol throws, whatever its bytes.
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
// Of the channels in an answer: in its line, or as columns in bytes that follow it (live/channel_columns.hpp).
enum class Encoding { json, cbor };

struct Hello {
  uint64_t protocol = 0;
  std::string token;
  bool free_running = false;  // "mode": "free"
  Detail detail = Detail::links;
  Encoding encoding = Encoding::json;
};

struct FrameMessage {
  uint64_t frame = 0;  // the client's own number, in the answer again
  double time_s = 0;
  std::vector<LivePose> vehicles;
  bool cold = false;             // forget what earlier frames have found
  bool between = false;          // "at": no poses, but a time between those of the last two frames
  std::optional<Detail> detail;  // instead of that of hello
};

struct Bye {};

using Message = std::variant<Hello, FrameMessage, Bye>;

// A message that is refused: its code and text go to the client.
struct ProtocolError : std::runtime_error {
  std::string code;
  std::optional<uint64_t> frame;  // of a frame message whose number is known
  ProtocolError(std::string error_code, const std::string& text)
      : std::runtime_error(text), code(std::move(error_code)) {}
};

// line: without its newline. max_vehicles: in one frame. Throws ProtocolError and nothing else but std::bad_alloc;
// takes memory in proportion to the line.
Message parse_message(std::string_view line, size_t max_vehicles);

}  // namespace wavetracer::live
