// SPDX-License-Identifier: Apache-2.0
// A pipeline handles the chunks: stages that call HDF5 run on one thread, the others on all cores.
// The last chunk of a table is padded with zeros, as HDF5 requires.
#include "output/packed_rows.hpp"
#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_pipeline.h>
#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include "base/stage_fault.hpp"
#include "output/hdf5.hpp"
#include "output/packed_ahead.hpp"
#include "output/packed_chunk.hpp"
#include "output/row_source.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using hdf5::File;
using hdf5::Id;

// A table of rows in the file.
struct StoredTable {
  std::string path;
  Id dataset;
  uint64_t begin = 0, bytes = 0;  // the range of its rows among the target places of pieces
  size_t value_bytes = 0, dimensions = 0;
  uint64_t row_bytes = 0, chunk_rows = 0;  // chunk_rows: 0 if it is not compressed
  bool packed() const { return chunk_rows > 0; }
  uint64_t chunk_bytes() const { return chunk_rows * row_bytes; }
};

struct Chunk {
  const StoredTable* table;
  uint64_t first_row;
};

StoredTable stored_table(const File& file, const std::string& path) {
  Id dataset(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + path);
  const Id type(H5Dget_type(dataset), H5Tclose, "find the type of " + path),
      space(H5Dget_space(dataset), H5Sclose, "measure " + path),
      properties(H5Dget_create_plist(dataset), H5Pclose, "read the layout of " + path);
  const std::vector<hsize_t> shape = hdf5::dimensions_of(space, path);
  StoredTable table{path, std::move(dataset), 0, 0, H5Tget_size(type), shape.size(), H5Tget_size(type), 0};
  for (size_t i = 1; i < shape.size(); ++i) table.row_bytes *= shape[i];
  table.bytes = shape.empty() ? 0 : shape[0] * table.row_bytes;
  if (H5Pget_layout(properties) == H5D_CHUNKED) {
    std::vector<hsize_t> chunk(shape.size());
    hdf5::checked(H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "read the chunks of " + path);
    table.chunk_rows = chunk.at(0);
  } else if (const haddr_t offset = H5Dget_offset(table.dataset); offset != HADDR_UNDEF) {
    table.begin = offset;
  }
  return table;
}

// Returns the paths of all datasets, those of a group before those of the next; groups may be in groups.
std::vector<std::string> datasets_below(const File& file, const std::string& group) {
  std::vector<std::string> out;
  for (const std::string& name : file.members(group.empty() ? "/" : group)) {
    const std::string path = group + "/" + name;
    const Id object(H5Oopen(file.id(), path.c_str(), H5P_DEFAULT), H5Oclose, "find " + path);
    if (H5Iget_type(object) == H5I_DATASET) {
      out.push_back(path);
      continue;
    }
    const std::vector<std::string> inner = datasets_below(file, path);
    out.insert(out.end(), inner.begin(), inner.end());
  }
  return out;
}

// Returns the tables of all groups, by path. Compressed ones lie one after the other.
std::vector<StoredTable> stored_tables(const File& file) {
  std::vector<StoredTable> tables;
  uint64_t begin = packed_begin;
  for (const std::string& path : datasets_below(file, "")) {
    StoredTable& table = tables.emplace_back(stored_table(file, path));
    if (!table.packed()) continue;
    table.begin = begin;
    begin += table.bytes;
  }
  return tables;
}

std::vector<Chunk> chunks_of(const std::vector<StoredTable>& tables) {
  std::vector<Chunk> chunks;
  for (const StoredTable& table : tables)
    if (table.packed())
      for (uint64_t row = 0; row * table.row_bytes < table.bytes; row += table.chunk_rows)
        chunks.push_back({&table, row});
  return chunks;
}

// Returns the chunk before it is compressed.
Bytes shuffled_rows(const Chunk& chunk, const RowSource& rows) {
  const StoredTable& table = *chunk.table;
  Bytes plain(table.chunk_bytes());
  const uint64_t from = chunk.first_row * table.row_bytes, size = std::min(table.chunk_bytes(), table.bytes - from);
  rows.read(table.begin + from, std::span(plain).first(size));
  return shuffled(plain, table.value_bytes);
}

std::vector<hsize_t> place_of(const Chunk& chunk) {
  std::vector<hsize_t> place(chunk.table->dimensions, 0);
  place.at(0) = chunk.first_row;
  return place;
}

// Reserves space on the disk ahead of the writes: HDF5 may crash if the disk becomes full.
class Room {
 public:
  Room(PendingFile& file, uint64_t used) : file_(file), used_(used), reserved_(used) {}
  void use(uint64_t bytes) {
    constexpr uint64_t least = uint64_t{1} << 22, notes = 256;  // bytes that HDF5 stores about a chunk
    used_ += bytes + notes;
    if (used_ + least <= reserved_) return;
    reserved_ = used_ + std::max(4 * least, used_ / 4);
    file_.reserve(reserved_);
  }

 private:
  PendingFile& file_;
  uint64_t used_, reserved_;
};

// The data passed from stage to stage.
struct Work {
  Chunk chunk;
  Bytes packed;
};
using WorkPointer = std::shared_ptr<Work>;

size_t chunks_at_once() { return 4 * static_cast<size_t>(tbb::info::default_concurrency()); }

// Returns the chunks in their order.
auto each_of(const std::vector<Chunk>& chunks, size_t& next, const StageFault& fault) {
  return tbb::make_filter<void, WorkPointer>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
    if (next == chunks.size() || fault.failed()) {
      flow.stop();
      return WorkPointer();
    }
    return std::make_shared<Work>(Work{chunks[next++], {}});
  });
}

uint64_t size_of(const File& file) {
  hsize_t size = 0;
  hdf5::checked(H5Fget_filesize(file.id(), &size), "measure the file");
  return size;
}

// Returns the length of the file afterwards, without the reserved space at its end.
uint64_t write_chunks(const RowSource& rows, PendingFile& out, uint32_t level, const PackedAhead* ahead) {
  File file = File::open_to_write(out.temporary());
  const std::vector<StoredTable> tables = stored_tables(file);
  const std::vector<Chunk> chunks = chunks_of(tables);
  Room room(out, size_of(file));
  StageFault fault;
  size_t next = 0;
  const auto pack = tbb::make_filter<WorkPointer, WorkPointer>(tbb::filter_mode::parallel, [&](WorkPointer work) {
    fault.run([&] {
      std::optional<Bytes> made;
      if (ahead) made = ahead->take(work->chunk.table->path, work->chunk.first_row);
      work->packed = made ? std::move(*made) : deflated(shuffled_rows(work->chunk, rows), level);
    });
    return work;
  });
  const auto write = tbb::make_filter<WorkPointer, void>(tbb::filter_mode::serial_in_order, [&](WorkPointer work) {
    fault.run([&] {
      room.use(work->packed.size());
      hdf5::checked(H5Dwrite_chunk(work->chunk.table->dataset, H5P_DEFAULT, 0, place_of(work->chunk).data(),
                                   work->packed.size(), work->packed.data()),
                    "write dataset " + work->chunk.table->path);
    });
  });
  tbb::parallel_pipeline(chunks_at_once(), each_of(chunks, next, fault) & pack & write);
  fault.rethrow();
  file.flush();
  return size_of(file);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& table) {
  throw RuntimeError(
      fmt::format("{}: {} does not read back as it was written, so nothing was removed; check the disk, "
                  "and run again with --resume",
                  file.string(), table));
}

void read_chunk(Work& work, const fs::path& path) {
  const StoredTable& table = *work.chunk.table;
  const std::vector<hsize_t> place = place_of(work.chunk);
  hsize_t size = 0;
  uint32_t left_out = 0;
  hdf5::checked(H5Dget_chunk_storage_size(table.dataset, place.data(), &size), "find a chunk of " + table.path);
  if (size > most_deflated_bytes(table.chunk_bytes())) refuse(path, table.path);
  work.packed.resize(size);
  hdf5::checked(H5Dread_chunk(table.dataset, H5P_DEFAULT, place.data(), &left_out, work.packed.data()),
                "read " + table.path);
  if (left_out != 0) refuse(path, table.path);
}

void prove_chunks(const RowSource& rows, const std::vector<Chunk>& chunks, const fs::path& path,
                  const PackedAhead* ahead) {
  size_t next = 0;
  StageFault fault;
  const auto read =
      tbb::make_filter<WorkPointer, WorkPointer>(tbb::filter_mode::serial_in_order, [&](WorkPointer work) {
        fault.run([&] { read_chunk(*work, path); });
        return work;
      });
  const auto compare = tbb::make_filter<WorkPointer, void>(tbb::filter_mode::parallel, [&](const WorkPointer& work) {
    fault.run([&] {
      const StoredTable& table = *work->chunk.table;
      const bool proved = ahead && ahead->proves(table.path, work->chunk.first_row, work->packed);
      if (!proved && !inflates_to(work->packed, shuffled_rows(work->chunk, rows))) refuse(path, table.path);
    });
  });
  tbb::parallel_pipeline(chunks_at_once(), each_of(chunks, next, fault) & read & compare);
  fault.rethrow();
}

void prove_plain(const RowSource& rows, const StoredTable& table, const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(table.begin));
  Bytes wanted, found;
  for (uint64_t done = 0; done < table.bytes; done += wanted.size()) {
    wanted.resize(std::min(packed_chunk_bytes, table.bytes - done));
    found.resize(wanted.size());
    rows.read(table.begin + done, wanted);
    if (!in.read(reinterpret_cast<char*>(found.data()), static_cast<std::streamsize>(found.size())) || found != wanted)
      refuse(path, table.path);
  }
}

}  // namespace

uint64_t full_chunk_rows(uint64_t row_bytes) {
  return row_bytes > 0 && row_bytes < packed_chunk_bytes ? packed_chunk_bytes / row_bytes : 0;
}

void write_rows(std::span<const fs::path> parts, const Pieces& pieces, PendingFile& file, uint32_t level,
                const PackedAhead* ahead) {
  Pieces plain(pieces.size()), packed(pieces.size());
  bool any = false;
  for (size_t i = 0; i < pieces.size(); ++i)
    for (const Piece& piece : pieces[i]) {
      (piece.to < packed_begin ? plain : packed)[i].push_back(piece);
      any = any || piece.to >= packed_begin;
    }
  copy_pieces(parts, plain, file);
  if (!any) return;
  const uint64_t size = write_chunks(RowSource(parts, packed), file, level, ahead);
  if (fs::file_size(file.temporary()) > size) fs::resize_file(file.temporary(), size);
}

void prove_rows(std::span<const fs::path> parts, const Pieces& pieces, const fs::path& path, const PackedAhead* ahead) {
  const RowSource rows(parts, pieces);
  const File file = File::open_to_read(path);
  const std::vector<StoredTable> tables = stored_tables(file);
  std::vector<const StoredTable*> plain;
  uint64_t found = 0;
  for (const StoredTable& table : tables) {
    if (table.bytes == 0 || !rows.begins_at(table.begin)) continue;  // the head of the file comes from no part
    found += table.bytes;
    if (!table.packed()) plain.push_back(&table);
  }
  if (found != rows.bytes()) refuse(path, "the number of its rows");
  tbb::parallel_for_each(plain, [&](const StoredTable* table) { prove_plain(rows, *table, path); });
  prove_chunks(rows, chunks_of(tables), path, ahead);
}

}  // namespace wavetracer
