// SPDX-License-Identifier: Apache-2.0
// Reads whole files into memory and writes them; errors name the file and give the system's reason.
// A file is written under a temporary name first and renamed when it is complete, so a failure leaves no partial file.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace wavetracer {

// Throws InputError when the file is missing, is not a plain file, is larger than 4 GiB, or cannot be read.
std::string read_file(const std::filesystem::path& path);
// Throws RuntimeError when the file cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace wavetracer
