// Frames follow each other; blocks share one frame, so its row is taken once and the paths it points to are added up.
// Room is reserved before HDF5 writes, which may crash where a disk is full.
#include "output/merge_outputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include "output/links_csv.hpp"
#include "output/merge_h5.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using hdf5::Column;
using hdf5::File;
using hdf5::Id;

constexpr uint64_t largest_attribute = uint64_t{1} << 26;  // bytes

// Groups of paths.h5 that blocks of one frame have in common, and those that each brings.
constexpr std::array<const char*, 2> shared_groups{"/frames", "/poses"};
constexpr std::array<const char*, 3> own_groups{"/links", "/paths", "/vertices"};

// /frames/path_offset of one frame: from 0 to the number of paths.
void set_path_count(const File& merged) {
  const std::array<uint64_t, 2> offset{0, Column(merged, "/paths/delay_s").shape()[0]};
  const Id dataset(H5Dopen2(merged.id(), "/frames/path_offset", H5P_DEFAULT), H5Dclose, "find /frames/path_offset");
  hdf5::checked(H5Dwrite(dataset, hdf5::Type<uint64_t>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, offset.data()),
                "write /frames/path_offset");
}

Pieces merge_blocks_h5(std::span<const fs::path> parts, const File& merged) {
  Pieces shared = merge_frames_h5(parts.first(1), shared_groups, merged);
  Pieces all = merge_frames_h5(parts, own_groups, merged);
  std::ranges::copy(shared[0], std::back_inserter(all[0]));
  return all;
}

PendingFile merge_h5(const H5Output& output, std::span<const fs::path> parts, bool of_one_frame, const fs::path& path,
                     const WriteHead& write_head) {
  PendingFile file(path);
  File head;
  write_head(output, head);
  const auto image = head.image();
  file.write(image);
  constexpr uint64_t slack = uint64_t{1} << 20;  // for the tables of contents
  uint64_t size = image.size() + slack;
  for (const fs::path& part : parts) size += fs::file_size(part);
  file.reserve(size);
  const Pieces pieces = [&] {
    File merged = File::open_to_write(file.temporary());
    Pieces found = of_one_frame ? merge_blocks_h5(parts, merged) : merge_frames_h5(parts, output.growing_groups, merged);
    merged.flush();
    return found;
  }();
  copy_pieces(parts, pieces, file);
  if (of_one_frame) {
    File merged = File::open_to_write(file.temporary());
    set_path_count(merged);
    merged.flush();
  }
  file.sync();
  return file;
}

herr_t copy_attribute(hid_t from, const char* name, const H5A_info_t*, void* to) {
  const Id attribute(H5Aopen(from, name, H5P_DEFAULT), H5Aclose, "find an attribute");
  const Id type(H5Aget_type(attribute), H5Tclose, "find the type of an attribute");
  const Id space(H5Aget_space(attribute), H5Sclose, "measure an attribute");
  const hssize_t values = H5Sget_simple_extent_npoints(space);
  const size_t bytes = H5Tget_size(type);
  if (values < 0 || bytes == 0 || static_cast<uint64_t>(values) > largest_attribute / bytes) return -1;
  std::vector<std::byte> value(static_cast<size_t>(values) * bytes);
  hdf5::checked(H5Aread(attribute, type, value.data()), "read an attribute");
  const Id copy(H5Acreate2(*static_cast<const hid_t*>(to), name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                "create an attribute");
  const herr_t written = H5Awrite(copy, type, value.data());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  return written;
}

bool same_type(const Column& a, const Column& b) { return H5Tequal(a.type(), b.type()) > 0; }

void check_part(const File& part, const File& first, const H5Output& output) {
  for (const std::string group : output.growing_groups) {
    const std::vector<std::string> names = part.members(group);
    if (names != first.members(group)) throw RuntimeError("group " + group + " has other members than the first part");
    for (const std::string& member : names) {
      const std::string name = group + "/" + member;
      const Column column(part, name), like(first, name);
      const auto &shape = column.shape(), &expected = like.shape();
      const bool same = !shape.empty() && shape.size() == expected.size() &&
                        std::equal(shape.begin() + 1, shape.end(), expected.begin() + 1) && same_type(column, like);
      if (!same) throw RuntimeError(name + " has another shape or type than in the first part");
      if (member.ends_with("_offset") &&
          (shape.size() != 1 || shape[0] == 0 || H5Tequal(column.type(), hdf5::Type<uint64_t>::file()) <= 0))
        throw RuntimeError(name + " holds no offsets");
      hdf5::check_stored(Id(H5Dopen2(part.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + name), name);
      hdf5::extent_of(part, name);
    }
  }
}

}  // namespace

std::vector<PendingFile> merge_outputs(const Config& config, const MergeParts& parts, const fs::path& directory,
                                       const WriteHead& write_head) {
  std::vector<PendingFile> files;
  const std::span<const H5Output> outputs = h5_outputs(config);
  for (size_t i = 0; i < outputs.size(); ++i)
    files.push_back(
        merge_h5(outputs[i], parts.files.at(i), parts.of_one_frame, directory / outputs[i].name, write_head));
  join_links_csv(parts.files.at(outputs.size()), files.emplace_back(directory / "links.csv"));
  files.back().sync();
  return files;
}

void copy_head(const fs::path& path, const H5Output& output, File& head) {
  const File file = File::open_to_read(path);
  const hid_t to = head.id();
  hdf5::checked(H5Aiterate2(file.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, copy_attribute, const_cast<hid_t*>(&to)),
                "copy the attributes of " + path.string());
  for (const std::string& name : file.members("/"))
    if (std::ranges::find(output.growing_groups, "/" + name) == output.growing_groups.end())
      hdf5::checked(H5Ocopy(file.id(), name.c_str(), to, name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                    "copy /" + name + " of " + path.string());
}

void check_parts(const H5Output& output, const std::vector<fs::path>& files) {
  if (files.empty()) return;
  const File first = File::open_to_read(files.front());
  for (const fs::path& path : files) {
    try {
      check_part(File::open_to_read(path), first, output);
    } catch (const RuntimeError& error) {
      throw RuntimeError(fmt::format("{}: {}; compute it again with --resume", path.string(), error.what()));
    }
  }
}

}  // namespace wavetracer
