// Small files of the program's own, whole into memory.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace wavetracer {

// Throws RuntimeError where the path is a folder or cannot be read, or where the file has more than most_bytes. The
// message names it, and ends with what to do.
std::string read_text(const std::filesystem::path& file, uint64_t most_bytes, const std::string& what_to_do);

}  // namespace wavetracer
