// SPDX-License-Identifier: Apache-2.0
// HDF5 makes the tables and says where their rows belong; it copies no row, as it has one thread.
// Space is reserved before HDF5 writes, since it may crash if a disk becomes full.
#include "output/table_layout.hpp"
#include <algorithm>
#include <map>
#include "output/packed_rows.hpp"

namespace wavetracer {
namespace {

using hdf5::File;

// Tells whether the rows are compressed, in chunks of less than the 4 GiB that HDF5 allows.
bool is_packed(const GrowingTable& table, uint32_t compression) {
  return compression > 0 && table.rows > 0 && full_chunk_rows(table.row_bytes()) > 0 &&
         table.rows * table.row_bytes() >= smallest_packed_bytes;
}

// Returns an upper bound of the file's growth: rows that are not compressed, and the library's data about groups,
// tables and attributes, with a margin.
uint64_t most_bytes(const std::vector<GrowingGroup>& groups, uint32_t compression) {
  constexpr uint64_t notes = 8192;
  uint64_t bytes = 0;
  for (const GrowingGroup& group : groups) {
    bytes += notes + 2 * group.description.size();
    for (const GrowingTable& table : group.tables)
      bytes += notes + 2 * (table.meaning.units.size() + table.meaning.description.size()) +
               (is_packed(table, compression) ? 0 : table.rows * table.row_bytes());
  }
  return bytes;
}

// Returns the target places of rows of compressed tables: one table after the other, by path.
std::map<std::string, uint64_t> packed_places(const std::vector<GrowingGroup>& groups, uint32_t compression) {
  std::map<std::pair<std::string, std::string>, uint64_t> sizes;  // by group and path
  for (const GrowingGroup& group : groups)
    for (const GrowingTable& table : group.tables)
      if (is_packed(table, compression)) sizes[{group.path, table.path}] = table.rows * table.row_bytes();
  std::map<std::string, uint64_t> places;
  uint64_t next = packed_begin;
  for (const auto& [name, bytes] : sizes) {
    places[name.second] = next;
    next += bytes;
  }
  return places;
}

}  // namespace

GrowingTable::GrowingTable(std::string name, hdf5::Meaning what, hid_t stored_as, std::vector<hsize_t> shape)
    : path(std::move(name)),
      meaning(std::move(what)),
      type(H5Tcopy(stored_as), H5Tclose, "copy the type of " + path),
      row_shape(std::move(shape)) {}

uint64_t GrowingTable::row_bytes() const {
  uint64_t bytes = H5Tget_size(type);
  for (const hsize_t n : row_shape) bytes *= n;
  return bytes;
}

void GrowingTable::take(size_t part, uint64_t from, hsize_t count, uint64_t last) {
  const hsize_t repeated = offsets() && rows > 0 ? 1 : 0;  // the last offset of the part before
  const uint64_t bytes = row_bytes();
  pieces.push_back({part, {from + repeated * bytes, rows * bytes, (count - repeated) * bytes, base_}});
  rows += count - repeated;
  if (offsets()) base_ += last;
}

Pieces make_tables(PendingFile& out, File& head, const std::vector<GrowingGroup>& groups, size_t parts,
                   uint32_t compression) {
  const auto image = head.image();
  out.write(image);
  out.reserve(image.size() + most_bytes(groups, compression));
  const std::map<std::string, uint64_t> packed = packed_places(groups, compression);
  Pieces pieces(parts);
  File file = File::open_to_write(out.temporary());
  for (const GrowingGroup& group : groups) {
    file.make_group(group.path, group.description);
    std::vector<const GrowingTable*> tables;
    for (const GrowingTable& table : group.tables) tables.push_back(&table);
    std::ranges::sort(tables, {}, &GrowingTable::path);
    for (const GrowingTable* table : tables) {
      std::vector<hsize_t> shape{table->rows};
      shape.insert(shape.end(), table->row_shape.begin(), table->row_shape.end());
      uint64_t start = 0;
      if (const auto place = packed.find(table->path); place != packed.end()) {
        start = place->second;
        const hsize_t chunk_rows = std::min<hsize_t>(table->rows, full_chunk_rows(table->row_bytes()));
        hdf5::make_packed(file, table->path, table->meaning, table->type, shape, {chunk_rows, compression});
      } else {
        start = hdf5::make_room(file, table->path, table->meaning, table->type, shape);
      }
      for (const auto& [part, piece] : table->pieces)
        if (piece.bytes > 0) pieces.at(part).push_back({piece.from, start + piece.to, piece.bytes, piece.base});
    }
  }
  file.flush();
  return pieces;
}

}  // namespace wavetracer
