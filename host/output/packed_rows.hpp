// Rows of many files into one, as copy_pieces() does it, and into tables that are compressed (output.compression): by
// all cores, chunk by chunk, as any reader of HDF5 knows it: the shuffle filter, then deflate.
#pragma once
#include <filesystem>
#include <span>
#include "output/copy_pieces.hpp"

namespace wavetracer {

class PackedAhead;

// Smaller tables are not compressed: what HDF5 notes of their chunks would take more than they save.
inline constexpr uint64_t smallest_packed_bytes = uint64_t{1} << 14;
// Of a chunk before it is compressed: four of them fit into the cache that readers have for a table by default.
inline constexpr uint64_t packed_chunk_bytes = uint64_t{1} << 18;
// Rows of each chunk of a table that has at least so many; 0 where rows of this size are not compressed.
uint64_t full_chunk_rows(uint64_t row_bytes);
// Pieces that go to a place from here on belong to compressed tables, which follow each other there as their paths do.
inline constexpr uint64_t packed_begin = uint64_t{1} << 62;

// Writes the rows into a file of make_tables() (table_layout.hpp). level: of the compression, 1 to 9; unused where no
// piece belongs to a compressed table. ahead: chunks that are made already (packed_ahead.hpp). Throws RuntimeError that
// names the part that is too short, or the file.
void write_rows(std::span<const std::filesystem::path> parts, const Pieces& pieces, PendingFile& file, uint32_t level,
                const PackedAhead* ahead = nullptr);

// Reads all these rows back from the file, compressed or not, and compares them with those of the parts, byte by byte;
// chunks that were made ahead were compared then, and have the bytes of then. Throws RuntimeError that names the first
// table that differs.
void prove_rows(std::span<const std::filesystem::path> parts, const Pieces& pieces, const std::filesystem::path& file,
                const PackedAhead* ahead = nullptr);

}  // namespace wavetracer
