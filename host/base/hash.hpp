// SPDX-License-Identifier: Apache-2.0
// Three hashes of byte strings, for names and checks of files on disk; they are unrelated to each other.
// Their values are the same in all versions and on all machines; none of them resists an adversary.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace wavetracer {

// FNV-1a, 128 bits (Fowler, Noll, Vo; RFC 9923), as 32 hexadecimal digits.
std::string fnv1a_128(std::string_view bytes);

// Folds the 64-bit words of the bytes, and their length, by the finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA
// 2014).
uint64_t mix64(std::string_view bytes);

struct FileHash {
  uint64_t bytes = 0, hash = 0;  // hash: mix64 of the file's content
};
// Returns zeros for a path that is not a plain file, such as a pipe, and nothing where the file cannot be read.
std::optional<FileHash> hash_of_file(const std::filesystem::path& file);

// XXH64 (Y. Collet, xxHash specification 0.1.1) with seed 0. The bytes may come block by block; one core hashes a few
// GB a second.
class ContentHash {
 public:
  void add(std::span<const std::byte> bytes);
  uint64_t value() const;

 private:
  static constexpr size_t stripe = 32;
  std::array<uint64_t, 4> lanes_{0x60EA27EEADC0B5D6u, 0xC2B2AE3D27D4EB4Fu, 0, 0x61C8864E7A143579u};
  std::array<std::byte, stripe> rest_{};  // the bytes that do not fill a stripe yet
  uint64_t bytes_ = 0;
  void take(const std::byte* whole_stripe);
};

// Hashes the content of a plain file; returns nothing where it cannot be read to its end.
std::optional<uint64_t> content_hash(const std::filesystem::path& file);

}  // namespace wavetracer
