// Small files of the program's own, whole into memory.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace wavetracer {

// Throws RuntimeError where the path is a folder or cannot be read, or where the file has more than most_bytes. The
// message names it, and ends with what to do.
std::string read_text(const std::filesystem::path& file, uint64_t most_bytes, const std::string& what_to_do);

// The same, and nothing where no such file is there: asked for in one step, as another process may remove it at any
// time.
std::optional<std::string> read_text_if_there(const std::filesystem::path& file, uint64_t most_bytes,
                                              const std::string& what_to_do);

}  // namespace wavetracer
