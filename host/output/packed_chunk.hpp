// SPDX-License-Identifier: Apache-2.0
// Makes a chunk of a compressed table as every reader of HDF5 understands it: the shuffle filter, then deflate.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wavetracer {

using Bytes = std::vector<std::byte>;

// Returns bytes in the order of the shuffle filter: all first bytes of the values, then all second ones, and so on.
Bytes shuffled(std::span<const std::byte> plain, size_t value_bytes);
// Returns one zlib stream. level: 1 to 9.
Bytes deflated(std::span<const std::byte> plain, uint32_t level);
bool inflates_to(std::span<const std::byte> packed, std::span<const std::byte> plain);
// Returns an upper bound of the compressed size of a chunk of this many bytes.
uint64_t most_deflated_bytes(uint64_t plain);

}  // namespace wavetracer
