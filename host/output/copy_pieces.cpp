// SPDX-License-Identifier: Apache-2.0
// Each part is one task with its own block of memory.
// The processor must be little-endian, as OpenCL devices and their hosts are.
#include "output/copy_pieces.hpp"
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cstring>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t copied_at_once_bytes = uint64_t{1} << 20;

void add(std::span<std::byte> numbers, uint64_t base) {
  for (size_t at = 0; at + sizeof base <= numbers.size(); at += sizeof base) {
    uint64_t number;
    std::memcpy(&number, numbers.data() + at, sizeof number);
    number += base;
    std::memcpy(numbers.data() + at, &number, sizeof number);
  }
}

void copy(std::ifstream& in, const std::filesystem::path& part, const Piece& piece, std::span<std::byte> block,
          const PendingFile& file) {
  for (uint64_t done = 0; done < piece.bytes;) {
    const std::span<std::byte> some = block.first(std::min<uint64_t>(block.size(), piece.bytes - done));
    read_piece(in, part, piece, done, some);
    file.write_at(piece.to + done, some);
    done += some.size();
  }
}

}  // namespace

void read_piece(std::ifstream& in, const std::filesystem::path& part, const Piece& piece, uint64_t from,
                std::span<std::byte> bytes) {
  in.seekg(static_cast<std::streamoff>(piece.from + from));
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw RuntimeError(part.string() + ": cannot be read to its end; remove it and run again with --resume");
  if (piece.base != 0) add(bytes, piece.base);
}

void copy_pieces(std::span<const std::filesystem::path> parts, const Pieces& pieces, const PendingFile& file) {
  tbb::parallel_for(size_t{0}, pieces.size(), [&](size_t i) {
    uint64_t most = 0;
    for (const Piece& piece : pieces[i]) most = std::max(most, piece.bytes);
    if (most == 0) return;
    std::vector<std::byte> block(std::min(most, copied_at_once_bytes));
    std::ifstream in(parts[i], std::ios::binary);
    for (const Piece& piece : pieces[i]) copy(in, parts[i], piece, block, file);
  });
}

}  // namespace wavetracer
