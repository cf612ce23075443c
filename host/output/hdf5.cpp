// SPDX-License-Identifier: Apache-2.0
// The few HDF5 operations that the outputs need; each is checked and closes what it opened.
// Strings are stored as variable-length UTF-8, so that a config text may exceed the 64 KiB of a fixed attribute.
#include "output/hdf5.hpp"
#include <fmt/format.h>
#include "wavetracer/error.hpp"

namespace wavetracer::hdf5 {
namespace {

herr_t innermost(unsigned depth, const H5E_error2_t* entry, void* reason) {
  if (depth == 0 && entry->desc) *static_cast<std::string*>(reason) = entry->desc;
  return 0;
}

Id string_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a string type");
  checked(H5Tset_size(type, H5T_VARIABLE), "make a string type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "make a string type");
  return type;
}

Id simple_space(const std::vector<hsize_t>& shape) {
  return Id(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "make a data space");
}

Id create_dataset(hid_t file, const std::string& path, hid_t type, hid_t space, hid_t creation) {
  return Id(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
            "create dataset " + path);
}

Id make_dataset(hid_t file, const std::string& path, const Meaning& meaning, hid_t type, hid_t space,
                const Id& creation = untimed()) {
  Id dataset = create_dataset(file, path, type, space, creation);
  write_attribute(dataset, "units", meaning.units);
  write_attribute(dataset, "description", meaning.description);
  return dataset;
}

void write_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type, hid_t space,
                     const void* value) {
  const Id attribute(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                     "create attribute " + name);
  checked(H5Awrite(attribute, memory_type, value), "write attribute " + name);
}

Id memory_access() {
  constexpr size_t growth_bytes = size_t{1} << 20;
  Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up a file in memory");
  checked(H5Pset_fapl_core(access, growth_bytes, /*backing_store=*/0), "set up a file in memory");
  return access;
}

}  // namespace

Id untimed() {
  Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up a dataset");
  checked(H5Pset_obj_track_times(creation, false), "set up a dataset");
  return creation;
}

hid_t checked(hid_t result, const std::string& doing) {
  if (result >= 0) return result;
  std::string reason = "no reason given";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &reason);
  throw RuntimeError(fmt::format("HDF5 cannot {}: {}", doing, reason));
}

Silence::Silence() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }

std::vector<hsize_t> dimensions_of(hid_t space, const std::string& path) {
  std::vector<hsize_t> shape(static_cast<size_t>(checked(H5Sget_simple_extent_ndims(space), "measure " + path)));
  checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "measure " + path);
  return shape;
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Id type = string_type();
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a data space");
  const char* value = text.c_str();
  write_attribute(object, name, type, type, space, &value);
}

void write_attribute(hid_t object, const std::string& name, std::span<const double> values) {
  write_attribute(object, name, Type<double>::file(), Type<double>::memory(), simple_space({values.size()}),
                  values.data());
}

void write_attribute(hid_t object, const std::string& name, uint32_t value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a data space");
  write_attribute(object, name, Type<uint32_t>::file(), Type<uint32_t>::memory(), space, &value);
}

std::string text_attribute(hid_t object, const std::string& name) {
  const Id attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
  char* value = nullptr;
  checked(H5Aread(attribute, string_type(), &value), "read attribute " + name);
  const std::string text = value == nullptr ? "" : value;
  H5free_memory(value);
  return text;
}

File::File()
    : access_(memory_access()),  // the library treats two files of one name as the same
      id_(H5Fcreate(fmt::format("wavetracer-in-memory-{}.h5", fmt::ptr(this)).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT,
                    access_),
          H5Fclose, "create a file in memory") {}

File::File(const std::filesystem::path& path, unsigned mode)
    : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up a file"),
      id_(H5Fopen(path.c_str(), mode, access_), H5Fclose, "open " + path.string()) {}

void File::flush() { checked(H5Fflush(id_, H5F_SCOPE_LOCAL), "write a file"); }

std::span<const std::byte> File::image() {
  flush();
  const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
  checked(size, "measure a file in memory");
  // The handle of the core driver is the address of its pointer to the bytes, so the whole file need not be copied.
  void* handle = nullptr;
  checked(H5Fget_vfd_handle(id_, access_, &handle), "read a file in memory");
  return {*static_cast<const std::byte* const*>(handle), static_cast<size_t>(size)};
}

Id File::make_group(const std::string& path, const std::string& description) const {
  Id group(H5Gcreate2(id_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create group " + path);
  write_attribute(group, "description", description);
  return group;
}

std::vector<std::string> File::members(const std::string& group) const {
  const Id id(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose, "find group " + group);
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* out) {
    static_cast<std::vector<std::string>*>(out)->push_back(name);
    return herr_t{0};
  };
  checked(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), "list group " + group);
  return names;
}

void File::write_strings(const std::string& path, const Meaning& meaning,
                         const std::vector<std::string>& values) const {
  const Id type = string_type();
  const Id dataset = make_dataset(id_, path, meaning, type, simple_space({values.size()}));
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  if (!pointers.empty())
    checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write dataset " + path);
}

Table::Table(const File& file, const std::string& path, const Meaning& meaning, hid_t file_type,
             std::vector<hsize_t> shape)
    : path_(path),
      shape_(std::move(shape)),
      space_(simple_space(shape_)),
      dataset_(make_dataset(file.id(), path, meaning, file_type, space_)) {
  for (size_t i = 1; i < shape_.size(); ++i) row_values_ *= shape_[i];
}

void Table::append_rows(hid_t memory_type, const void* values, hsize_t rows) {
  std::vector<hsize_t> start(shape_.size(), 0), block = shape_;
  start[0] = next_row_;
  block[0] = rows;
  checked(H5Sselect_hyperslab(space_, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
          "select rows of " + path_);
  checked(H5Dwrite(dataset_, memory_type, simple_space(block), space_, H5P_DEFAULT, values), "write dataset " + path_);
  next_row_ += rows;
}

Id make_untimed(const File& file, const std::string& path, hid_t type, hid_t space) {
  return create_dataset(file.id(), path, type, space, untimed());
}

uint64_t make_room(const File& file, const std::string& path, const Meaning& meaning, hid_t type,
                   const std::vector<hsize_t>& shape) {
  const Id creation = untimed();
  checked(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), "make room for " + path);
  checked(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "make room for " + path);
  const Id dataset = make_dataset(file.id(), path, meaning, type, simple_space(shape), creation);
  const haddr_t offset = H5Dget_offset(dataset);
  return offset == HADDR_UNDEF ? 0 : offset;
}

void make_packed(const File& file, const std::string& path, const Meaning& meaning, hid_t type,
                 const std::vector<hsize_t>& shape, Packing packing) {
  const Id creation = untimed();
  std::vector<hsize_t> chunk = shape;
  chunk.at(0) = packing.chunk_rows;
  checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "cut " + path + " into chunks");
  checked(H5Pset_shuffle(creation), "compress " + path);
  checked(H5Pset_deflate(creation, packing.level), "compress " + path);
  checked(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "compress " + path);
  make_dataset(file.id(), path, meaning, type, simple_space(shape), creation);
}

void check_stored(hid_t dataset, const std::string& path) {
  constexpr hsize_t most_unpacked = 1032;  // largest number of bytes that deflate can make of one stored byte
  const Id properties(H5Dget_create_plist(dataset), H5Pclose, "read the layout of " + path);
  const bool packed = H5Pget_layout(properties) == H5D_CHUNKED && H5Pget_nfilters(properties) > 0;
  const Id space(H5Dget_space(dataset), H5Sclose, "measure dataset " + path);
  const Id type(H5Dget_type(dataset), H5Tclose, "find the type of " + path);
  hsize_t bytes = H5Tget_size(type);
  for (const hsize_t n : dimensions_of(space, path))
    if (__builtin_mul_overflow(bytes, n, &bytes)) throw RuntimeError(path + " is too large");
  if (H5Dget_storage_size(dataset) < bytes / (packed ? most_unpacked : 1)) throw RuntimeError(path + " is cut short");
}

Column::Column(const File& file, const std::string& path)
    : path_(path),
      dataset_(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + path),
      type_(H5Dget_type(dataset_), H5Tclose, "find the type of " + path),
      space_(H5Dget_space(dataset_), H5Sclose, "measure dataset " + path),
      shape_(dimensions_of(space_, path)) {}

Meaning Column::meaning() const { return {text_attribute(dataset_, "units"), text_attribute(dataset_, "description")}; }

Extent Column::extent() const {
  if (shape_.empty()) throw RuntimeError("dataset " + path_ + " has no rows");
  check_stored(dataset_, path_);
  Extent extent{shape_[0], H5Tget_size(type_), 0};
  for (size_t i = 1; i < shape_.size(); ++i) extent.row_bytes *= shape_[i];
  if (extent.rows == 0 || extent.row_bytes == 0) return extent;
  extent.offset = H5Dget_offset(dataset_);
  if (extent.offset == HADDR_UNDEF) throw RuntimeError("dataset " + path_ + " is not stored in one piece");
  return extent;
}

}  // namespace wavetracer::hdf5
