// SPDX-License-Identifier: Apache-2.0
// Each HDF5 output has a temporary file, OUTPUT.rows, which is one part with a piece per frame and table
// (table_layout.hpp). The processor must be little-endian, as files are.
#include "output/frame_tables.hpp"
#include <algorithm>
#include <cstring>
#include "output/packed_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t block_bytes = size_t{1} << 20;

std::filesystem::path beside(const std::filesystem::path& path) { return path.string() + ".rows"; }

}  // namespace

FrameTables::FrameTables(const std::filesystem::path& path) : out_(path), rows_(beside(path)) {}

void FrameTables::group(const std::string& path, const std::string& description) {
  const auto [found, fresh] = group_rows_.try_emplace(path, groups_.size());
  if (fresh) groups_.push_back({path, description, {}});
  group_ = found->second;
}

GrowingTable& FrameTables::table(const std::string& path, const hdf5::Meaning& meaning, hid_t type,
                                 const std::vector<hsize_t>& row_shape) {
  std::vector<GrowingTable>& tables = groups_.at(group_).tables;
  const auto [found, fresh] = table_rows_.try_emplace(path, tables.size());
  if (fresh) tables.emplace_back(path, meaning, type, row_shape);
  return tables[found->second];
}

void FrameTables::append_rows(const std::string& name, const hdf5::Meaning& meaning, hid_t type,
                              std::span<const std::byte> bytes, hsize_t rows, const std::vector<hsize_t>& row_shape) {
  GrowingTable& to = table(groups_.at(group_).path + "/" + name, meaning, type, row_shape);
  if (to.rows == 0)
    for (size_t i = 0; i < row_shape.size(); ++i) to.row_shape[i] = std::max(to.row_shape[i], row_shape[i]);
  if (rows == 0) return;
  if (to.row_shape != row_shape)
    throw RuntimeError(to.path + ": rows of frames differ in shape; this is a fault of wavetracer, report it");
  uint64_t last = 0;
  if (to.offsets()) std::memcpy(&last, bytes.data() + bytes.size() - sizeof last, sizeof last);
  to.take(0, written_, rows, last);
  written_ += bytes.size();
  if (waiting_.size() + bytes.size() > block_bytes) flush();
  if (bytes.size() > block_bytes)
    rows_.write(bytes);
  else
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

void FrameTables::flush() {
  rows_.write(waiting_);
  waiting_.clear();
}

PendingFile FrameTables::finish(hdf5::File& head, uint32_t compression) {
  flush();
  const std::filesystem::path part = rows_.temporary();
  write_rows({&part, 1}, make_tables(out_, head, groups_, 1, compression), out_, compression);
  out_.sync();
  return std::move(out_);
}

}  // namespace wavetracer
