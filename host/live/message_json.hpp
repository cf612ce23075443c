// SPDX-License-Identifier: Apache-2.0
// Reads the JSON of a message from an untrusted client: whatever exceeds a limit is refused while it is read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace wavetracer::live {

inline constexpr uint64_t max_frame = (1ull << 53) - 1;  // largest number that JSON readers hold exactly
inline constexpr size_t max_quoted_bytes = 60;

// Quotes text of a client, cut so that it fits into an answer; json::dump would refuse half a character.
std::string in_quotes(std::string_view text);

// Throws a ProtocolError.
[[noreturn]] void refuse(const char* code, const std::string& text);

// Returns the line as JSON, in time proportional to its length. Throws ProtocolError for invalid JSON, for a key that
// occurs twice, for deep nesting, and for more entries than messages have or, in "vehicles", than max_vehicles; if
// valid JSON gave the frame number before that, the error has it.
nlohmann::json read_message_json(std::string_view line, size_t max_vehicles);

}  // namespace wavetracer::live
