// SPDX-License-Identifier: Apache-2.0
// Reads whole files into memory and writes them; errors name the file and give the system's reason. A file is written
// under a temporary name first and renamed when it is complete, so a failure leaves no partial file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wavetracer {

// Throws InputError when the file is missing, is not a plain file, is larger than 4 GiB, or cannot be read.
std::string read_file(const std::filesystem::path& path);
// Throws RuntimeError when the file cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

// Reads a small file that the program itself wrote. Throws RuntimeError if the path is a folder, cannot be read, or has
// more than most_bytes. The message names the file and ends with what_to_do.
std::string read_text(const std::filesystem::path& file, uint64_t most_bytes, const std::string& what_to_do);

// Does the same, but returns nothing if the file does not exist. That is tested and read in one step, since another
// process may remove the file at any time.
std::optional<std::string> read_text_if_there(const std::filesystem::path& file, uint64_t most_bytes,
                                              const std::string& what_to_do);

}  // namespace wavetracer
