// SPDX-License-Identifier: Apache-2.0
// Parses text of trajectory files as numbers, and makes their error messages: file, line, what is wrong.
// The decimal point is that of the C locale, whatever the locale of the program is.
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

// Parses the whole text as a finite number; blanks around it are allowed.
std::optional<double> finite_number(std::string_view text);

// Parses seconds, or SUMO's --human-readable-time: [days:]hours:minutes:seconds.
std::optional<double> seconds(std::string_view text);

}  // namespace wavetracer
