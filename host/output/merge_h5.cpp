// SPDX-License-Identifier: Apache-2.0
// Reads the parts once, one of them open at a time. HDF5 copies no row: it has one thread, and
// would take a second for each gigabyte. Parts are not trusted: each must have the datasets of the first, with equal
// shapes except for their rows.
#include "output/merge_h5.hpp"
#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <vector>
#include "output/hdf5_read.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using hdf5::Column;
using hdf5::Extent;
using hdf5::File;
using Groups = std::vector<std::string>;

// Groups that are the same in all blocks of one frame; each block has its own rows of the others.
constexpr std::array<std::string_view, 2> shared_groups{"/frames", "/poses"};

GrowingGroup empty_group(const std::string& path, const File& part) {
  const hdf5::Id id(H5Gopen2(part.id(), path.c_str(), H5P_DEFAULT), H5Gclose, "find group " + path);
  GrowingGroup group{path, hdf5::text_attribute(id, "description"), {}};
  for (const std::string& name : part.members(path)) {
    const Column like(part, path + "/" + name);
    if (like.shape().empty()) throw RuntimeError(like.path() + " has no rows");
    const GrowingTable& table = group.tables.emplace_back(like.path(), like.meaning(), like.type(),
                                                          std::vector(like.shape().begin() + 1, like.shape().end()));
    if (table.offsets() && (!table.row_shape.empty() || H5Tequal(like.type(), hdf5::Type<uint64_t>::file()) <= 0))
      throw RuntimeError(like.path() + " holds no offsets");
  }
  return group;
}

// Returns what a part says about its run, or nothing if it says nothing.
std::optional<GrowingParts::RunOfPart> run_of(const File& part) {
  if (H5Lexists(part.id(), "/inputs", H5P_DEFAULT) <= 0) return std::nullopt;
  const hdf5::NumberColumn<uint64_t> hashes(part, "/inputs/hash");
  return GrowingParts::RunOfPart{hdf5::read_strings(part, "/inputs/name"), hdf5::read_strings(part, "/inputs/file"),
                                 hashes.read(0, hashes.rows()), hdf5::text_attribute(part.id(), "config")};
}

// The part itself is checked as well as the manifest: a file may have been replaced by another. Configurations contain
// the places of input files, so they are compared only if these are the same.
void check_run(const std::optional<GrowingParts::RunOfPart>& part,
               const std::optional<GrowingParts::RunOfPart>& first) {
  if (!part || !first) return;
  if (part->names != first->names || part->hashes != first->hashes)
    throw RuntimeError("it is of a run with other input files than the first part");
  if (part->files == first->files && part->config != first->config)
    throw RuntimeError("it is of a run with another configuration than the first part");
}

void check_datasets(const File& part, const std::vector<GrowingGroup>& groups) {
  for (const GrowingGroup& group : groups) {
    std::vector<std::string> paths;
    for (const std::string& name : part.members(group.path)) paths.push_back(group.path + "/" + name);
    if (!std::ranges::equal(paths, group.tables, {}, {}, &GrowingTable::path))
      throw RuntimeError("it has other datasets than the first part");
  }
}

uint64_t number_at(std::ifstream& file, uint64_t offset, const std::string& path) {
  uint64_t number = 0;
  if (!file.seekg(static_cast<std::streamoff>(offset)).read(reinterpret_cast<char*>(&number), sizeof number))
    throw RuntimeError("cannot read dataset " + path);
  return number;
}

bool same_rows(const Column& column, const GrowingTable& table) {
  const auto& shape = column.shape();
  return !shape.empty() && std::equal(shape.begin() + 1, shape.end(), table.row_shape.begin(), table.row_shape.end()) &&
         H5Tequal(column.type(), table.type) > 0;
}

// Takes the rows of this part.
void take(GrowingTable& table, size_t index, const File& part, std::ifstream& bytes) {
  const Column column(part, table.path);
  const Extent extent = column.extent();
  if (!same_rows(column, table)) throw RuntimeError(table.path + " has another shape or type than in the first part");
  if (table.offsets() && extent.rows == 0) throw RuntimeError(table.path + " is empty");
  const uint64_t last =
      table.offsets() ? number_at(bytes, extent.offset + (extent.rows - 1) * extent.row_bytes, table.path) : 0;
  table.take(index, extent.offset, extent.rows, last);
}

uint64_t rows_of(const std::vector<GrowingGroup>& groups, const std::string& path) {
  for (const GrowingGroup& group : groups)
    for (const GrowingTable& table : group.tables)
      if (table.path == path) return table.rows;
  return 0;
}

// Makes the offsets of the one frame, which ended with the first block's paths, end with the paths of all blocks.
void point_to(GrowingTable& path_offset, uint64_t first_paths, uint64_t all_paths) {
  if (path_offset.rows != 2) throw RuntimeError(path_offset.path + " is not of one frame");
  const auto [part, whole] = path_offset.pieces.at(0);
  const uint64_t bytes = path_offset.row_bytes();
  path_offset.pieces = {{part, {whole.from, whole.to, bytes, 0}},
                        {part, {whole.from + bytes, whole.to + bytes, bytes, all_paths - first_paths}}};
}

}  // namespace

void GrowingParts::add(const std::filesystem::path& part) {
  reading_part(part, [&] {
    const File file = File::open_to_read(part);
    if (parts_.empty()) {
      for (const std::string& path : names_) groups_.push_back(empty_group(path, file));
      first_ = run_of(file);
    } else {
      check_run(run_of(file), first_);
    }
    check_datasets(file, groups_);
    std::ifstream bytes(part, std::ios::binary);
    for (GrowingGroup& group : groups_)
      for (GrowingTable& table : group.tables) take(table, parts_.size(), file, bytes);
  });
  parts_.push_back(part);
}

std::vector<GrowingGroup> growing_groups_of(std::span<const std::filesystem::path> parts, const Groups& groups,
                                            const BeginPart& begin) {
  GrowingParts grown(groups);
  for (const std::filesystem::path& part : parts) {
    begin(part);
    grown.add(part);
  }
  return std::move(grown).groups();
}

// The row of the frame is that of the first part.
std::vector<GrowingGroup> groups_of_blocks(std::span<const std::filesystem::path> parts, const Groups& groups,
                                           const BeginPart& begin) {
  std::vector<GrowingGroup> first = growing_groups_of(parts.first(1), groups, begin),
                            all = growing_groups_of(parts, groups, begin);
  for (size_t i = 0; i < all.size(); ++i) {
    if (std::ranges::find(shared_groups, all[i].path) == shared_groups.end()) continue;
    std::swap(all[i].tables, first[i].tables);
    for (GrowingTable& table : all[i].tables)
      if (table.path == "/frames/path_offset")
        reading_part(parts.front(),
                     [&] { point_to(table, rows_of(first, "/paths/delay_s"), rows_of(all, "/paths/delay_s")); });
  }
  return all;
}

}  // namespace wavetracer
