// The JSON of a message, of a client that nobody trusts: what has too much of anything is refused while it is read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace wavetracer::live {

inline constexpr uint64_t max_frame = (1ull << 53) - 1;  // that JSON numbers hold exactly, everywhere
inline constexpr size_t max_quoted_bytes = 60;

// What came from a client, cut so that it fits into an answer; json::dump would refuse half a character.
std::string in_quotes(std::string_view text);

// Throws a ProtocolError.
[[noreturn]] void refuse(const char* code, const std::string& text);

// line as JSON, in time in proportion to its length. Throws ProtocolError for what is no JSON, for a key that occurs
// twice, for nesting, and for more entries than messages have or, in "vehicles", than max_vehicles; of JSON the error
// has the number of the frame if that came before.
nlohmann::json read_message_json(std::string_view line, size_t max_vehicles);

}  // namespace wavetracer::live
