// SPDX-License-Identifier: Apache-2.0
// The HDF5 C library with C++ lifetimes and exceptions; this is the only header that includes hdf5.h.
// Files are built in memory, or on disk in space that was reserved before: HDF5 1.10 may crash if the disk becomes
// full.
#pragma once
#include <hdf5.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace wavetracer::hdf5 {

// Returns the result, or throws RuntimeError with the library's own reason if it is negative.
hid_t checked(hid_t result, const std::string& doing);

// An identifier of the library; it is closed with the function for its kind.
class Id {
 public:
  using Close = herr_t (*)(hid_t);
  Id(hid_t id, Close close, const std::string& doing) : id_(checked(id, doing)), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id& operator=(Id&&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

// Returns properties of a dataset without its creation time, which would make files of equal contents differ.
Id untimed();

// While it exists, the library prints no error stacks to stderr: failures are exceptions.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

template <typename T>
struct Type;
template <>
struct Type<uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t file() { return H5T_STD_U8LE; }
};
template <>
struct Type<uint32_t> {
  static hid_t memory() { return H5T_NATIVE_UINT32; }
  static hid_t file() { return H5T_STD_U32LE; }
};
template <>
struct Type<uint64_t> {
  static hid_t memory() { return H5T_NATIVE_UINT64; }
  static hid_t file() { return H5T_STD_U64LE; }
};
template <>
struct Type<float> {
  static hid_t memory() { return H5T_NATIVE_FLOAT; }
  static hid_t file() { return H5T_IEEE_F32LE; }
};
template <>
struct Type<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t file() { return H5T_IEEE_F64LE; }
};

// The attributes of a dataset: "units" (SI, "1" for pure numbers) and "description".
struct Meaning {
  std::string units;
  std::string description;
};

void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, std::span<const double> values);
void write_attribute(hid_t object, const std::string& name, uint32_t value);

std::string text_attribute(hid_t object, const std::string& name);

class File {
 public:
  // Makes an empty file in memory; its image() is the content for the file on disk.
  File();
  // A file on disk. Data that is not flushed may be lost silently.
  static File open_to_read(const std::filesystem::path& path) { return File(path, H5F_ACC_RDONLY); }
  static File open_to_write(const std::filesystem::path& path) { return File(path, H5F_ACC_RDWR); }

  hid_t id() const { return id_; }
  // Returns the bytes of a file in memory, valid until the file changes or is destroyed.
  std::span<const std::byte> image();
  void flush();
  Id make_group(const std::string& path, const std::string& description) const;
  // Returns the names of the members of a group, sorted.
  std::vector<std::string> members(const std::string& group) const;
  void write_strings(const std::string& path, const Meaning& meaning, const std::vector<std::string>& values) const;

 private:
  File(const std::filesystem::path& path, unsigned mode);

  Silence silence_;
  Id access_;
  Id id_;
};

// A dataset of rows with the shape (rows, inner...), filled from its first row on, one block at a time.
// It is contiguous and not compressed.
class Table {
 public:
  Table(const File& file, const std::string& path, const Meaning& meaning, hid_t file_type, std::vector<hsize_t> shape);
  void append_rows(hid_t memory_type, const void* values, hsize_t rows);
  // Number of values in one row.
  hsize_t row_values() const { return row_values_; }

 private:
  std::string path_;
  std::vector<hsize_t> shape_;
  hsize_t row_values_ = 1;
  hsize_t next_row_ = 0;
  Id space_;
  Id dataset_;
};

// Makes a dataset without attributes, and without the times that HDF5 stores by default.
Id make_untimed(const File& file, const std::string& path, hid_t type, hid_t space);

// Makes a dataset that rows of other files will fill (copy_pieces.hpp). Returns the offset of the rows in the file,
// valid once it is closed; 0 if there are none.
uint64_t make_room(const File& file, const std::string& path, const Meaning& meaning, hid_t type,
                   const std::vector<hsize_t>& shape);

// The compression of a dataset: rows of a chunk, level of deflate.
struct Packing {
  hsize_t chunk_rows = 0;
  uint32_t level = 0;
};
// Makes a dataset of compressed chunks, none of which is written yet (packed_rows.hpp).
void make_packed(const File& file, const std::string& path, const Meaning& meaning, hid_t type,
                 const std::vector<hsize_t>& shape, Packing packing);

// The place of a dataset's rows in its file.
struct Extent {
  hsize_t rows = 0;
  uint64_t row_bytes = 0, offset = 0;
};

// Returns the size of each dimension. path: for the error.
std::vector<hsize_t> dimensions_of(hid_t space, const std::string& path);

// Checks that the stored data have the size of the shape: the library would fill in missing data, and a small file
// could ask for all memory. For compressed datasets, as others may write them, the size must be at least what deflate
// needs. Throws RuntimeError.
void check_stored(hid_t dataset, const std::string& path);

// The type and shape of a dataset of rows.
class Column {
 public:
  Column(const File& file, const std::string& path);
  const std::string& path() const { return path_; }
  hid_t type() const { return type_; }  // the type in the file
  Meaning meaning() const;
  const std::vector<hsize_t>& shape() const { return shape_; }
  // Throws RuntimeError if the rows are missing, or not in one piece, as those of our files are.
  Extent extent() const;

 private:
  std::string path_;
  Id dataset_, type_, space_;
  std::vector<hsize_t> shape_;
};

template <typename T>
class Rows {
 public:
  Rows(const File& file, const std::string& path, const Meaning& meaning, std::vector<hsize_t> shape)
      : table_(file, path, meaning, Type<T>::file(), std::move(shape)) {}
  // Appends whole rows.
  void append(std::span<const T> values) {
    if (!values.empty()) table_.append_rows(Type<T>::memory(), values.data(), values.size() / table_.row_values());
  }

 private:
  Table table_;
};

}  // namespace wavetracer::hdf5
