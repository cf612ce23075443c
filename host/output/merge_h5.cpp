// One walk over the parts, one of them open beside the first at a time, then the tables. HDF5 copies no row: it has one
// thread, and would take a second for each gigabyte. Parts may be anybody's: each must have the datasets of the first,
// in equal shapes but for their rows.
#include "output/merge_h5.hpp"
#include <algorithm>
#include <fstream>
#include <string>
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
  Column like;   // of the first part
  bool offsets;  // has one entry more than rows, and counts on from part to part
  hsize_t rows = 0;
  uint64_t base = 0;
};

std::vector<std::string> datasets_in(const File& part, Groups groups) {
  std::vector<std::string> paths;
  for (const std::string group : groups)
    for (const std::string& name : part.members(group)) paths.push_back(group + "/" + name);
  return paths;
}

std::vector<Target> targets_in(const File& part, const std::vector<std::string>& datasets) {
  std::vector<Target> targets;
  for (const std::string& path : datasets) {
    targets.push_back({Column(part, path), path.ends_with("_offset")});
    const Target& target = targets.back();
    if (target.offsets &&
        (target.like.shape().size() != 1 || H5Tequal(target.like.type(), hdf5::Type<uint64_t>::file()) <= 0))
      throw RuntimeError(path + " holds no offsets");
  }
  return targets;
}

void make_groups(const File& part, Groups groups, const File& merged) {
  for (const std::string group : groups) {
    const hdf5::Id id(H5Gopen2(part.id(), group.c_str(), H5P_DEFAULT), H5Gclose, "find group " + group);
    merged.make_group(group, hdf5::text_attribute(id, "description"));
  }
}

// Where the rows of the new table begin in the merged file.
uint64_t make_table(const Target& target, const File& merged) {
  std::vector<hsize_t> shape = target.like.shape();
  shape[0] = target.rows;
  return hdf5::make_room(merged, target.like.path(), target.like.meaning(), target.like.type(), shape);
}

uint64_t number_at(std::ifstream& file, uint64_t offset, const std::string& path) {
  uint64_t number = 0;
  if (!file.seekg(static_cast<std::streamoff>(offset)).read(reinterpret_cast<char*>(&number), sizeof number))
    throw RuntimeError("cannot read dataset " + path);
  return number;
}

bool same_rows(const Column& a, const Column& b) {
  return a.shape().size() == b.shape().size() &&
         std::equal(a.shape().begin() + 1, a.shape().end(), b.shape().begin() + 1) && H5Tequal(a.type(), b.type()) > 0;
}

// The rows of this part, and where they go in the table.
Piece take(Target& target, const File& part, std::ifstream& file) {
  const Column column(part, target.like.path());
  const Extent extent = column.extent();
  if (!same_rows(column, target.like))
    throw RuntimeError(column.path() + " has another shape or type than in the first part");
  if (target.offsets && extent.rows == 0) throw RuntimeError(column.path() + " is empty");
  const hsize_t repeated = target.offsets && target.rows > 0 ? 1 : 0;  // what the part before ended with
  const hsize_t rows = extent.rows - repeated;
  const Piece piece{extent.offset + repeated * extent.row_bytes, target.rows * extent.row_bytes,
                    rows * extent.row_bytes, target.base};
  target.rows += rows;
  if (target.offsets)
    target.base += number_at(file, extent.offset + (extent.rows - 1) * extent.row_bytes, column.path());
  return piece;
}

// What each part brings to each dataset, in the order of the targets.
class Walk {
 public:
  Walk(const std::filesystem::path& first, Groups groups)
      : groups_(groups),
        first_(File::open_to_read(first)),
        datasets_(datasets_in(first_, groups)),
        targets_(targets_in(first_, datasets_)) {}

  std::vector<Piece> take_part(const std::filesystem::path& path) {
    const File part = File::open_to_read(path);
    if (datasets_in(part, groups_) != datasets_) throw RuntimeError("it has other datasets than the first part");
    std::ifstream file(path, std::ios::binary);
    std::vector<Piece> pieces;
    for (Target& target : targets_) pieces.push_back(take(target, part, file));
    return pieces;
  }

  void make_tables(const File& merged, Pieces& pieces) const {
    make_groups(first_, groups_, merged);
    for (size_t i = 0; i < targets_.size(); ++i) {
      const uint64_t start = make_table(targets_[i], merged);
      for (std::vector<Piece>& of_part : pieces) of_part[i].to += start;
    }
  }

 private:
  Groups groups_;
  File first_;
  std::vector<std::string> datasets_;
  std::vector<Target> targets_;
};

}  // namespace

Pieces merge_frames_h5(std::span<const std::filesystem::path> parts, Groups groups, const File& merged,
                       const BeginPart& begin) {
  begin(parts.front());
  Walk walk = reading_part(parts.front(), [&] { return Walk(parts.front(), groups); });
  Pieces pieces;
  for (const std::filesystem::path& part : parts) {
    begin(part);
    pieces.push_back(reading_part(part, [&] { return walk.take_part(part); }));
  }
  begin(parts.front());
  walk.make_tables(merged, pieces);
  return pieces;
}

}  // namespace wavetracer
