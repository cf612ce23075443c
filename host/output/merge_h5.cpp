// One walk over the parts, one of them open at a time, then the tables. HDF5 copies no row: it has one thread, and would
// take a second for each gigabyte.
// Assumes that all parts have the datasets of the first, in equal shapes but for their rows.
#include "output/merge_h5.hpp"
#include <fstream>
#include <vector>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using hdf5::Column;
using hdf5::Extent;
using hdf5::File;
using Groups = std::span<const char* const>;

// A dataset of the merged file on its way.
struct Target {
  std::string path;
  bool offsets;  // has one entry more than rows, and counts on from part to part
  hsize_t rows = 0;
  uint64_t base = 0;
  uint64_t row_bytes = 0;  // of the first part
};

std::vector<Target> targets_in(const File& part, Groups groups) {
  std::vector<Target> targets;
  for (const std::string group : groups)
    for (const std::string& name : part.members(group))
      targets.push_back({.path = group + "/" + name, .offsets = name.ends_with("_offset")});
  return targets;
}

void make_groups(const File& part, Groups groups, const File& merged) {
  for (const std::string group : groups) {
    const hdf5::Id id(H5Gopen2(part.id(), group.c_str(), H5P_DEFAULT), H5Gclose, "find group " + group);
    merged.make_group(group, hdf5::text_attribute(id, "description"));
  }
}

// Where the rows of the new table begin in the merged file.
uint64_t make_table(const Target& target, const File& first, const File& merged) {
  const Column like(first, target.path);
  std::vector<hsize_t> shape = like.shape();
  shape[0] = target.rows;
  return hdf5::make_room(merged, target.path, like.meaning(), like.type(), shape);
}

uint64_t number_at(std::ifstream& file, uint64_t offset, const std::string& path) {
  uint64_t number = 0;
  if (!file.seekg(static_cast<std::streamoff>(offset)).read(reinterpret_cast<char*>(&number), sizeof number))
    throw RuntimeError("cannot read dataset " + path);
  return number;
}

// The rows of this part, and where they go in the table.
Piece take(Target& target, const Extent& extent, std::ifstream& file) {
  if (target.offsets && extent.rows == 0) throw RuntimeError(target.path + " is empty");
  if (target.row_bytes == 0) target.row_bytes = extent.row_bytes;
  if (target.row_bytes != extent.row_bytes) throw RuntimeError(target.path + " has other rows than in the first part");
  const hsize_t repeated = target.offsets && target.rows > 0 ? 1 : 0;  // what the part before ended with
  const hsize_t rows = extent.rows - repeated;
  const Piece piece{extent.offset + repeated * extent.row_bytes, target.rows * extent.row_bytes,
                    rows * extent.row_bytes, target.base};
  target.rows += rows;
  if (target.offsets) target.base += number_at(file, extent.offset + (extent.rows - 1) * extent.row_bytes, target.path);
  return piece;
}

}  // namespace

Pieces merge_frames_h5(std::span<const std::filesystem::path> parts, Groups groups, const File& merged) {
  std::vector<Target> targets;
  Pieces pieces;
  for (const std::filesystem::path& path : parts) {
    const File part = File::open_to_read(path);
    if (targets.empty()) targets = targets_in(part, groups);
    std::ifstream file(path, std::ios::binary);
    std::vector<Piece>& of_part = pieces.emplace_back();
    for (Target& target : targets) of_part.push_back(take(target, hdf5::extent_of(part, target.path), file));
  }
  const File first = File::open_to_read(parts.front());
  make_groups(first, groups, merged);
  for (size_t i = 0; i < targets.size(); ++i) {
    const uint64_t start = make_table(targets[i], first, merged);
    for (std::vector<Piece>& of_part : pieces) of_part[i].to += start;
  }
  return pieces;
}

}  // namespace wavetracer
