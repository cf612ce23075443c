// Text of trajectory files as numbers, and the form of their errors: file, line, what is wrong.
// Assumes the C locale's decimal point, whatever the locale of the program is.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace wavetracer {

// Throws InputError "file:line: what".
[[noreturn]] void fail_at(const std::string& file, uint64_t line, std::string_view what);

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);  // ASCII letters only

// The whole text as a finite number, blanks around it allowed.
std::optional<double> finite_number(std::string_view text);

// Seconds, or SUMO's --human-readable-time: [days:]hours:minutes:seconds.
std::optional<double> seconds(std::string_view text);

}  // namespace wavetracer
