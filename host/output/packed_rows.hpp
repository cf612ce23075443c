// SPDX-License-Identifier: Apache-2.0
// Copies rows of many files into one, as copy_pieces() does, and also into compressed tables (output.compression). All
// cores compress, chunk by chunk, in the format of every HDF5 reader: the shuffle filter, then deflate.
#pragma once
#include <filesystem>
#include <span>
#include "output/copy_pieces.hpp"

namespace wavetracer {

class PackedAhead;

// Smaller tables are not compressed: HDF5's data about their chunks would take more space than they save.
inline constexpr uint64_t smallest_packed_bytes = uint64_t{1} << 14;
// Size of a chunk before compression: four chunks fit into the default cache that readers have for a table.
inline constexpr uint64_t packed_chunk_bytes = uint64_t{1} << 18;
// Returns the rows per chunk of a table that has at least that many; 0 if rows of this size are not compressed.
uint64_t full_chunk_rows(uint64_t row_bytes);
// Target places from here on belong to compressed tables, which follow each other in the order of their paths.
inline constexpr uint64_t packed_begin = uint64_t{1} << 62;

// Writes the rows into a file of make_tables() (table_layout.hpp). level: of the compression, 1 to 9; unused if no
// piece belongs to a compressed table. ahead: chunks that are compressed already (packed_ahead.hpp). Throws
// RuntimeError that names the part that is too short, or the file.
void write_rows(std::span<const std::filesystem::path> parts, const Pieces& pieces, PendingFile& file, uint32_t level,
                const PackedAhead* ahead = nullptr);

// Reads all these rows back from the file, compressed or not, and compares them with those of the parts, byte by byte;
// chunks that were made ahead were compared when they were made, so only their bytes are checked. Throws RuntimeError
// that names the first table that differs.
void prove_rows(std::span<const std::filesystem::path> parts, const Pieces& pieces, const std::filesystem::path& file,
                const PackedAhead* ahead = nullptr);

}  // namespace wavetracer
