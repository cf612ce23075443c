// Two unrelated hashes of byte strings, for names and checks of files on disk.
// Stable between versions and machines; neither resists an adversary.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wavetracer {

// FNV-1a, 128 bits (Fowler, Noll, Vo; RFC 9923), as 32 hexadecimal digits.
std::string fnv1a_128(std::string_view bytes);

// 64-bit words folded by the finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014), length included.
uint64_t mix64(std::string_view bytes);

struct FileHash {
  uint64_t bytes = 0, hash = 0;  // mix64 of its content
};
// Zeros of what is no plain file, such as a pipe; nothing where it cannot be read.
std::optional<FileHash> hash_of_file(const std::filesystem::path& file);

}  // namespace wavetracer
