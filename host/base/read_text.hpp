// SPDX-License-Identifier: Apache-2.0
// Reads small files that the program itself wrote.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace wavetracer {

// Throws RuntimeError if the path is a folder, cannot be read, or has more than most_bytes. The message names the file
// and ends with what_to_do.
std::string read_text(const std::filesystem::path& file, uint64_t most_bytes, const std::string& what_to_do);

// Does the same, but returns nothing if the file does not exist. That is tested and read in one step, since another
// process may remove the file at any time.
std::optional<std::string> read_text_if_there(const std::filesystem::path& file, uint64_t most_bytes,
                                              const std::string& what_to_do);

}  // namespace wavetracer
