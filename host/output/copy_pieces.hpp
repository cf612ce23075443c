// SPDX-License-Identifier: Apache-2.0
// Copies rows of many files into one without the HDF5 library: plain bytes, on all cores.
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>
#include "base/pending_file.hpp"

namespace wavetracer {

// Bytes that are copied from one file to another; offsets are in bytes from the beginning of each file.
struct Piece {
  uint64_t from = 0, to = 0, bytes = 0;
  // Added to each 64-bit number of the piece; if it is not 0, the piece must consist of such numbers.
  uint64_t base = 0;
};

// [part]: the pieces of each part that go into the file.
using Pieces = std::vector<std::vector<Piece>>;

// Target ranges of pieces must not overlap. Throws RuntimeError that names the part if one is shorter than expected, or
// the file if it cannot be written.
void copy_pieces(std::span<const std::filesystem::path> parts, const Pieces& pieces, const PendingFile& file);

// Reads bytes of a piece from an offset on, with its base added: if that is not 0, they must be whole numbers. in: the
// part, open. Throws RuntimeError that names the part if it is shorter.
void read_piece(std::ifstream& in, const std::filesystem::path& part, const Piece& piece, uint64_t from,
                std::span<std::byte> bytes);

}  // namespace wavetracer
