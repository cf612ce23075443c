// FNV-1a of 128 bits and a splitmix64 fold.
// Assumes a compiler with 128-bit integers (GCC, Clang) and a little-endian machine, as all OpenCL hosts here are.
#include "gpu/hash.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cstring>

namespace wavetracer::gpu {

std::string fnv1a_128(std::string_view bytes) {
  using Word = unsigned __int128;
  constexpr Word prime = (static_cast<Word>(0x0000000001000000ull) << 64) | 0x000000000000013Bull;
  Word hash = (static_cast<Word>(0x6c62272e07bb0142ull) << 64) | 0x62b821756295c58dull;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * prime;
  return fmt::format("{:016x}{:016x}", static_cast<uint64_t>(hash >> 64), static_cast<uint64_t>(hash));
}

uint64_t mix64(std::string_view bytes) {
  uint64_t hash = bytes.size();
  for (size_t i = 0; i < bytes.size(); i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash += word + 0x9e3779b97f4a7c15ull;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace wavetracer::gpu
