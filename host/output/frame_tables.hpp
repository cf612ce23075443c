// SPDX-License-Identifier: Apache-2.0
// The tables of an HDF5 output that grow with frames, written one frame at a time: rows go to a temporary file first,
// and to their final places once their number is known. Memory holds no frame.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "output/hdf5.hpp"
#include "output/table_layout.hpp"

namespace wavetracer {

class FrameTables {
 public:
  // path: of the file that finish() makes; rows are stored beside it until then.
  explicit FrameTables(const std::filesystem::path& path);

  // Begins the group of the following tables, in the order of the file.
  void group(const std::string& path, const std::string& description);
  // Appends rows to a table of the last group; the first call creates the table, even without rows. Offsets begin with
  // 0 in each call. Rows of different shapes are a RuntimeError; the shape of zero rows need not be known.
  template <typename T>
  void append(const std::string& name, const hdf5::Meaning& meaning, std::span<const T> values,
              const std::vector<hsize_t>& row_shape = {}) {
    hsize_t row_values = 1;
    for (const hsize_t n : row_shape) row_values *= n;
    append_rows(name, meaning, hdf5::Type<T>::file(), std::as_bytes(values), values.size() / row_values, row_shape);
  }
  // Appends one row, which may have no values.
  template <typename T>
  void append_row(const std::string& name, const hdf5::Meaning& meaning, std::span<const T> values,
                  const std::vector<hsize_t>& row_shape) {
    append_rows(name, meaning, hdf5::Type<T>::file(), std::as_bytes(values), 1, row_shape);
  }

  // Returns the file, synced but not in place. compression: level of deflate, 0 to 9, 0 for none. Nothing can be
  // appended afterwards. Throws RuntimeError.
  PendingFile finish(hdf5::File& head, uint32_t compression = 0);

 private:
  PendingFile out_, rows_;
  uint64_t written_ = 0;            // bytes of rows_, including those in waiting_
  std::vector<std::byte> waiting_;  // at most one block
  std::vector<GrowingGroup> groups_;
  std::map<std::string, size_t> group_rows_, table_rows_;  // path to index among the groups, and within its group
  size_t group_ = 0;

  void append_rows(const std::string& name, const hdf5::Meaning& meaning, hid_t type, std::span<const std::byte> bytes,
                   hsize_t rows, const std::vector<hsize_t>& row_shape);
  GrowingTable& table(const std::string& path, const hdf5::Meaning& meaning, hid_t type,
                      const std::vector<hsize_t>& row_shape);
  void flush();
};

}  // namespace wavetracer
