// Two unrelated hashes of byte strings, for names and checks of files on disk.
// Stable between versions and machines; neither resists an adversary.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace wavetracer::gpu {

// FNV-1a, 128 bits (Fowler, Noll, Vo; RFC 9923), as 32 hexadecimal digits.
std::string fnv1a_128(std::string_view bytes);

// 64-bit words folded by the finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014), length included.
uint64_t mix64(std::string_view bytes);

}  // namespace wavetracer::gpu
