// Frames follow each other; blocks share one frame, so its row is taken once and the paths it points to are added up.
// Room is reserved before HDF5 writes, which may crash where a disk is full.
#include "output/merge_outputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstring>
#include "output/limited_child.hpp"
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

Pieces merge_blocks_h5(std::span<const fs::path> parts, const File& merged, const BeginPart& begin) {
  Pieces shared = merge_frames_h5(parts.first(1), shared_groups, merged, begin);
  Pieces all = merge_frames_h5(parts, own_groups, merged, begin);
  std::ranges::copy(shared[0], std::back_inserter(all[0]));
  return all;
}

// An output on its way: all that the HDF5 library does to it, before and after the rows are copied.
struct Draft {
  const H5Output& output;
  std::span<const fs::path> parts;
  bool of_one_frame;
  const WriteHead& write_head;
  PendingFile& file;

  Pieces make_tables(const BeginPart& begin) const {
    begin(parts.front());
    File head;
    write_head(output, head);
    const auto image = head.image();
    file.write(image);
    constexpr uint64_t slack = uint64_t{1} << 20;  // for the tables of contents
    uint64_t size = image.size() + slack;
    for (const fs::path& part : parts) size += fs::file_size(part);
    file.reserve(size);
    File merged = File::open_to_write(file.temporary());
    const Pieces pieces = of_one_frame ? merge_blocks_h5(parts, merged, begin)
                                       : merge_frames_h5(parts, output.growing_groups, merged, begin);
    merged.flush();
    return pieces;
  }

  void finish() const {
    if (!of_one_frame) return;
    File merged = File::open_to_write(file.temporary());
    set_path_count(merged);
    merged.flush();
  }
};

// Pieces as bytes: of each part their number, then they themselves.
void send(const Pieces& pieces, LimitedChild::Reply& reply) {
  for (const std::vector<Piece>& of_part : pieces) {
    const uint64_t count = of_part.size();
    reply.send(&count, sizeof count);
    reply.send(of_part.data(), count * sizeof(Piece));
  }
}

Pieces pieces_in(std::string_view bytes) {
  Pieces pieces;
  const auto take = [&bytes](void* to, uint64_t count, size_t size) {
    if (count > bytes.size() / size) throw RuntimeError("the process that reads the parts answers too little");
    std::memcpy(to, bytes.data(), count * size);
    bytes.remove_prefix(count * size);
  };
  while (!bytes.empty()) {
    uint64_t count = 0;
    take(&count, 1, sizeof count);
    std::vector<Piece>& of_part = pieces.emplace_back(std::min<uint64_t>(count, bytes.size() / sizeof(Piece)));
    take(of_part.data(), count, sizeof(Piece));
  }
  return pieces;
}

void write_own(const Draft& draft) {
  copy_pieces(draft.parts, draft.make_tables([](const fs::path&) {}), draft.file);
  draft.finish();
}

void write_foreign(const Draft& draft) {
  constexpr std::string_view tables = "tables", finish = "finish";
  LimitedChild child(draft.parts.front().string(), [&](std::string_view request, LimitedChild::Reply& reply) {
    if (request == finish) return draft.finish();
    send(draft.make_tables([&reply](const fs::path& part) { reply.at_file(part.string()); }), reply);
  });
  copy_pieces(draft.parts, pieces_in(child.request(tables)), draft.file);
  child.request(finish);
}

PendingFile merge_h5(const H5Output& output, std::span<const fs::path> parts, bool of_one_frame, Parts whose,
                     const fs::path& path, const WriteHead& write_head) {
  PendingFile file(path);
  const Draft draft{output, parts, of_one_frame, write_head, file};
  whose == Parts::own ? write_own(draft) : write_foreign(draft);
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

}  // namespace

std::vector<PendingFile> merge_outputs(const Config& config, const MergeParts& parts, Parts whose,
                                       const fs::path& directory, const WriteHead& write_head) {
  std::vector<PendingFile> files;
  const std::span<const H5Output> outputs = h5_outputs(config);
  for (size_t i = 0; i < outputs.size(); ++i)
    files.push_back(
        merge_h5(outputs[i], parts.files.at(i), parts.of_one_frame, whose, directory / outputs[i].name, write_head));
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

}  // namespace wavetracer
