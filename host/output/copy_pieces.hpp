// Rows of many files into one without the library that made them: bytes from here to there, on all cores.
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>
#include "base/pending_file.hpp"

namespace wavetracer {

// Bytes of one file that become bytes of another; offsets in bytes from the beginning of each.
struct Piece {
  uint64_t from = 0, to = 0, bytes = 0;
  uint64_t base = 0;  // added to each 64-bit number of it, of which it must consist if this is not 0
};

// [part]: what of each part goes into the file.
using Pieces = std::vector<std::vector<Piece>>;

// Pieces may not overlap where they go to. Throws RuntimeError that names the part, where one is shorter than it says,
// or the file, where it cannot be written.
void copy_pieces(std::span<const std::filesystem::path> parts, const Pieces& pieces, const PendingFile& file);

// Bytes of a piece, from this one of them on, with its base added: whole numbers where that is not 0. in: the part,
// open. Throws RuntimeError that names the part where it is shorter.
void read_piece(std::ifstream& in, const std::filesystem::path& part, const Piece& piece, uint64_t from,
                std::span<std::byte> bytes);

}  // namespace wavetracer
