// Two walks over the parts: one to add up rows, one to copy them. One part is open at a time.
// Assumes that all parts have the datasets of the first, in equal shapes but for their rows.
#include "output/merge_h5.hpp"
#include <algorithm>
#include <optional>
#include <vector>

namespace wavetracer {
namespace {

using hdf5::Column;
using hdf5::File;
using hdf5::Table;
using Groups = std::span<const char* const>;

constexpr size_t block_bytes = size_t{4} << 20;

// A dataset of the merged file on its way.
struct Target {
  std::string path;
  bool offsets;  // has one entry more than rows, and counts on from part to part
  hsize_t rows = 0;
  uint64_t base = 0;
  std::optional<Table> table{};  // once `rows` is known
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

void make_table(Target& target, const File& part, const File& merged) {
  const Column like(part, target.path);
  std::vector<hsize_t> shape = like.shape();
  shape[0] = target.rows;
  target.table.emplace(merged, target.path, like.meaning(), like.type(), shape);
}

void copy(Target& target, const File& part, bool first, std::vector<std::byte>& block) {
  const Column column(part, target.path);
  const hsize_t rows = column.shape()[0];
  if (rows == 0 || column.row_bytes() == 0) return;
  const hsize_t step = std::max<hsize_t>(1, block_bytes / column.row_bytes());
  for (hsize_t row = target.offsets && !first ? 1 : 0; row < rows; row += step) {
    const hsize_t count = std::min(step, rows - row);
    block.resize(count * column.row_bytes());
    column.read(row, count, block.data());
    if (target.offsets)
      for (uint64_t& offset : std::span(reinterpret_cast<uint64_t*>(block.data()), count)) offset += target.base;
    target.table->append_rows(column.type(), block.data(), count);
  }
  if (target.offsets) {
    column.read(rows - 1, 1, block.data());
    target.base += *reinterpret_cast<const uint64_t*>(block.data());
  }
}

}  // namespace

void merge_frames_h5(std::span<const std::filesystem::path> parts, Groups groups, const File& merged) {
  std::vector<Target> targets;
  for (const std::filesystem::path& path : parts) {
    const File part = File::open_to_read(path);
    if (targets.empty()) targets = targets_in(part, groups);
    for (Target& target : targets) {
      const bool counted_before = target.offsets && target.rows > 0;
      target.rows += Column(part, target.path).shape()[0] - (counted_before ? 1 : 0);
    }
  }
  std::vector<std::byte> block;
  for (const std::filesystem::path& path : parts) {
    const File part = File::open_to_read(path);
    const bool first = &path == &parts.front();
    if (first) make_groups(part, groups, merged);
    for (Target& target : targets) {
      if (first) make_table(target, part, merged);
      copy(target, part, first, block);
    }
  }
}

}  // namespace wavetracer
