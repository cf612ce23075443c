// SPDX-License-Identifier: Apache-2.0
// Checks that an input file is a plain file, and not larger than its reader allows, before a reader opens it.
// A pipe or a device might never end.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace wavetracer {

// Returns a message that says what the path is instead of a plain file and what to do about it; it is empty if the file
// is fine. what: names the file in the message, such as "the scene file".
std::string input_file_problem(const std::filesystem::path& path, const char* what, uint64_t most_bytes = ~uint64_t{0});
// Throws InputError with the path and the problem.
void check_input_file(const std::filesystem::path& path, const char* what, uint64_t most_bytes = ~uint64_t{0});

// Returns a hint such as "; did you mean 'a/b.ply'? ..." for a path that does not exist and contains backslashes (which
// separate folders on Windows only) or the control characters that TOML turns them into. It is empty for any other
// path.
std::string backslash_hint(const std::filesystem::path& path);

}  // namespace wavetracer
