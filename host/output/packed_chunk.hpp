// A chunk of a compressed table as any reader of HDF5 knows it: the shuffle filter, then deflate.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wavetracer {

using Bytes = std::vector<std::byte>;

// Bytes in the order that the shuffle filter gives them: all first bytes of the values, then all second ones, and so
// on.
Bytes shuffled(std::span<const std::byte> plain, size_t value_bytes);
// One zlib stream. level: 1 to 9.
Bytes deflated(std::span<const std::byte> plain, uint32_t level);
bool inflates_to(std::span<const std::byte> packed, std::span<const std::byte> plain);
// More than any chunk of so many bytes takes once it is compressed.
uint64_t most_deflated_bytes(uint64_t plain);

}  // namespace wavetracer
