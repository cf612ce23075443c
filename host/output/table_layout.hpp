// SPDX-License-Identifier: Apache-2.0
// The tables of an HDF5 output that grow with frames, and their one layout in the file: the head, then the groups in
// their order, then the tables of each by name. So equal contents give equal bytes, whoever wrote the parts.
#pragma once
#include <string>
#include <utility>
#include <vector>
#include "base/pending_file.hpp"
#include "output/copy_pieces.hpp"
#include "output/hdf5.hpp"

namespace wavetracer {

struct GrowingTable {
  GrowingTable(std::string path, hdf5::Meaning meaning, hid_t type, std::vector<hsize_t> row_shape);
  // Takes the next rows: `count` of them from a byte of a part on. last: for offsets, the last number there.
  void take(size_t part, uint64_t from, hsize_t count, uint64_t last = 0);
  uint64_t row_bytes() const;
  // Tells whether it holds offsets: it begins with 0, has one entry more than the rows it counts, and continues from
  // part to part.
  bool offsets() const { return path.ends_with("_offset"); }

  std::string path;
  hdf5::Meaning meaning;
  hdf5::Id type;                   // type in the file
  std::vector<hsize_t> row_shape;  // () for one number per row
  hsize_t rows = 0;

  // By part; target places are counted from the beginning of the table.
  std::vector<std::pair<size_t, Piece>> pieces;

 private:
  uint64_t base_ = 0;
};

struct GrowingGroup {
  std::string path, description;
  std::vector<GrowingTable> tables;
};

// Fills an empty file with this head and these tables, but without the rows: returns the places of each part's rows
// (packed_rows.hpp). compression: level of deflate, 0 to 9; 0 stores rows uncompressed. Throws RuntimeError.
Pieces make_tables(PendingFile& out, hdf5::File& head, const std::vector<GrowingGroup>& groups, size_t parts,
                   uint32_t compression);

}  // namespace wavetracer
