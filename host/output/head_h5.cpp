// SPDX-License-Identifier: Apache-2.0
// Copies by value and in the order of names, so that the bytes of a copy depend on the content alone.
// H5Ocopy would keep traces of how its source was written.
#include "output/head_h5.hpp"
#include <algorithm>
#include <vector>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using hdf5::File;
using hdf5::Id;

constexpr uint64_t largest_value = uint64_t{1} << 29;  // bytes of an attribute or dataset, without texts

// Returns the bytes of this number of values; 0 if they are too many.
size_t bytes_of(hid_t type, hid_t space) {
  const hssize_t values = H5Sget_simple_extent_npoints(space);
  const size_t bytes = H5Tget_size(type);
  if (values < 0 || bytes == 0 || static_cast<uint64_t>(values) > largest_value / bytes)
    throw RuntimeError("the head of the file is too large");
  return static_cast<size_t>(values) * bytes;
}

// This runs inside the library's C code, which exceptions must not cross.
herr_t add_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

void copy_attribute(hid_t from, const std::string& name, hid_t to) {
  const Id attribute(H5Aopen(from, name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
  const Id type(H5Aget_type(attribute), H5Tclose, "find the type of attribute " + name);
  const Id space(H5Aget_space(attribute), H5Sclose, "measure attribute " + name);
  std::vector<std::byte> value(bytes_of(type, space));
  hdf5::checked(H5Aread(attribute, type, value.data()), "read attribute " + name);
  const Id copy(H5Acreate2(to, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                "create attribute " + name);
  const herr_t written = H5Awrite(copy, type, value.data());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  hdf5::checked(written, "write attribute " + name);
}

void copy_attributes(hid_t from, hid_t to) {
  std::vector<std::string> names;
  hdf5::checked(H5Aiterate2(from, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names), "list attributes");
  for (const std::string& name : names) copy_attribute(from, name, to);
}

void copy_dataset(const File& from, const std::string& path, const File& to) {
  const Id dataset(H5Dopen2(from.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + path);
  hdf5::check_stored(dataset, path);
  const Id type(H5Dget_type(dataset), H5Tclose, "find the type of " + path);
  const Id space(H5Dget_space(dataset), H5Sclose, "measure dataset " + path);
  std::vector<std::byte> value(bytes_of(type, space));
  hdf5::checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), "read dataset " + path);
  const Id copy = hdf5::make_untimed(to, path, type, space);
  const herr_t written = H5Dwrite(copy, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  hdf5::checked(written, "write dataset " + path);
  copy_attributes(dataset, copy);
}

void copy_head(const H5Output& output, const File& from, const File& to) {
  copy_attributes(from.id(), to.id());
  const auto grows = [&](const std::string& path) {
    return std::ranges::find(output.growing_groups, path) != output.growing_groups.end();
  };
  for (const std::string& name : from.members("/")) {
    const std::string path = "/" + name;
    if (grows(path)) continue;
    const Id group(H5Gopen2(from.id(), path.c_str(), H5P_DEFAULT), H5Gclose, "find group " + path),
        copy(H5Gcreate2(to.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
             "create group " + path);
    copy_attributes(group, copy);
    for (const std::string& member : from.members(path))
      if (const std::string inner = path + "/" + member; !grows(inner)) copy_dataset(from, inner, to);
  }
}

}  // namespace

void make_head(const H5Output& output, const Run& run, File& head) {
  File file;
  output.encode_head(run, file);
  copy_head(output, file, head);
}

void copy_head(const H5Output& output, const std::filesystem::path& path, File& head) {
  copy_head(output, File::open_to_read(path), head);
}

}  // namespace wavetracer
