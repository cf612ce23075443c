// What every input file must be before a reader opens it: a plain file, of a size that its reader can take.
// A pipe or a device would be waited for, or read, for ever.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace wavetracer {

// What is there instead, and what to do; empty where all is well. what: the file in a few words, "the scene file".
std::string input_file_problem(const std::filesystem::path& path, const char* what, uint64_t most_bytes = ~uint64_t{0});
// Throws InputError with the path and the problem.
void check_input_file(const std::filesystem::path& path, const char* what, uint64_t most_bytes = ~uint64_t{0});

// "; did you mean 'a/b.ply'? ..." for a name that is not there and has backslashes, which part folders on Windows
// alone, or the characters that TOML makes of them; empty for any other name.
std::string backslash_hint(const std::filesystem::path& path);

}  // namespace wavetracer
