// SPDX-License-Identifier: Apache-2.0
// Writes the messages of the server: one line of JSON per message, newline included; docs/live.md has the schema.
// Doubles are printed with enough digits to read back to the same bits; values that are not finite are null.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "live/message.hpp"
#include "live/radar_answer.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::live {

// Returns the answer to hello: the ends and vehicles of the world, and the limits.
std::string world_line(const Simulation& simulation);

struct FrameTimes {
  double wait_s = 0, solve_s = 0;  // from the end of the message to the start of the solver; in the solver
};
struct AnswerForm {
  Detail detail = Detail::links;
  Encoding encoding = Encoding::json;
};
// With Encoding::cbor the line has "bytes" instead of "links", and that number of bytes of channel_columns() follows
// it. skipped: frames of a free-running client since its last answer that newer ones replaced.
std::string channels_line(const FrameMessage& asked, const LiveFrame& frame, const AnswerForm& form, uint64_t skipped,
                          const FrameTimes& times, const RadarAnswer& radars);

// fatal: the connection ends after it.
std::string error_line(std::string_view code, std::string_view text, std::optional<uint64_t> frame, bool fatal);
std::string bye_line(std::string_view reason);

}  // namespace wavetracer::live
