// SPDX-License-Identifier: Apache-2.0
// Uses zlib, and a loop for the shuffle.
#include "output/packed_chunk.hpp"
#include <zlib.h>
#include <algorithm>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

Bytef* zlib_bytes(std::byte* bytes) { return reinterpret_cast<Bytef*>(bytes); }
const Bytef* zlib_bytes(const std::byte* bytes) { return reinterpret_cast<const Bytef*>(bytes); }

}  // namespace

Bytes shuffled(std::span<const std::byte> plain, size_t value_bytes) {
  Bytes out(plain.size());
  const size_t values = plain.size() / value_bytes;
  for (size_t byte = 0; byte < value_bytes; ++byte)
    for (size_t i = 0; i < values; ++i) out[byte * values + i] = plain[i * value_bytes + byte];
  return out;
}

Bytes deflated(std::span<const std::byte> plain, uint32_t level) {
  uLongf size = compressBound(plain.size());
  Bytes out(size);
  if (compress2(zlib_bytes(out.data()), &size, zlib_bytes(plain.data()), plain.size(), static_cast<int>(level)) != Z_OK)
    throw RuntimeError("zlib cannot compress a chunk; this is a fault of wavetracer, report it");
  out.resize(size);
  return out;
}

bool inflates_to(std::span<const std::byte> packed, std::span<const std::byte> plain) {
  Bytes out(plain.size());
  uLongf size = out.size();
  return uncompress(zlib_bytes(out.data()), &size, zlib_bytes(packed.data()), packed.size()) == Z_OK &&
         size == plain.size() && std::ranges::equal(out, plain);
}

uint64_t most_deflated_bytes(uint64_t plain) { return compressBound(plain); }

}  // namespace wavetracer
