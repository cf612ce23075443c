// What the server says: one line of JSON a message, newline included; docs/live.md is the schema.
// Doubles are printed with as many digits as read back to the same bits; what is not finite is null.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "live/message.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::live {

// The answer to hello: what there is, and what is allowed.
std::string world_line(const Simulation& simulation);

struct FrameTimes {
  double wait_s = 0, solve_s = 0;  // from the end of the message to the solver; there
};
struct AnswerForm {
  Detail detail = Detail::links;
  Encoding encoding = Encoding::json;
};
// With Encoding::cbor the line has "bytes" instead of "links", and so many bytes of channel_columns() follow it.
// skipped: frames of a free-running client since its last answer that newer ones replaced. frequency_hz: of the
// carrier.
std::string channels_line(const FrameMessage& asked, const LiveFrame& frame, const AnswerForm& form, uint64_t skipped,
                          const FrameTimes& times, double frequency_hz);

// fatal: the connection ends with it.
std::string error_line(std::string_view code, std::string_view text, std::optional<uint64_t> frame, bool fatal);
std::string bye_line(std::string_view reason);

}  // namespace wavetracer::live
