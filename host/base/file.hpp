// Whole files in and out of memory, with errors that name the file and the system's reason.
// Writing goes to a temporary name first and is renamed when complete, so a failure leaves no partial file.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace wavetracer {

// Throws InputError when the file is missing, no plain file, larger than 4 GiB, or unreadable.
std::string read_file(const std::filesystem::path& path);
// Throws RuntimeError when the file cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace wavetracer
