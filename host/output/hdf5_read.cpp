// SPDX-License-Identifier: Apache-2.0
// Every size that a file states is compared with the stored data before memory is allocated for it.
// Only the library undoes filters.
#include "output/hdf5_read.hpp"
#include <fmt/format.h>
#include "wavetracer/error.hpp"

namespace wavetracer::hdf5 {
namespace {

constexpr hsize_t largest_dataset = hsize_t{1} << 40;  // number of values
constexpr hsize_t most_strings = hsize_t{1} << 24;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw RuntimeError(fmt::format("{} {}", path, what));
}

std::vector<hsize_t> limited_dimensions_of(hid_t space, const std::string& path) {
  if (H5Sis_simple(space) <= 0) refuse(path, "has no rows");
  const std::vector<hsize_t> shape = dimensions_of(space, path);
  if (shape.empty() || shape.size() > 4) refuse(path, fmt::format("has {} dimensions", shape.size()));
  hsize_t values = 1;
  for (const hsize_t n : shape)
    if (__builtin_mul_overflow(values, n, &values) || values > largest_dataset) refuse(path, "is too large");
  return shape;
}

// Reads a string type as the file has it: variable or fixed length.
std::vector<std::string> strings_of(hid_t type, size_t count, const std::string& path, const auto& read) {
  if (H5Tget_class(type) != H5T_STRING) refuse(path, "holds no text");
  std::vector<std::string> out;
  if (count == 0) return out;
  if (H5Tis_variable_str(type) > 0) {
    const Id memory(H5Tcopy(H5T_C_S1), H5Tclose, "make a string type");
    checked(H5Tset_size(memory, H5T_VARIABLE), "make a string type");
    checked(H5Tset_cset(memory, H5Tget_cset(type)), "make a string type");
    std::vector<char*> values(count, nullptr);
    const herr_t result = read(memory, values.data());
    for (char* value : values) {
      out.emplace_back(result >= 0 && value != nullptr ? value : "");
      if (value != nullptr) H5free_memory(value);
    }
    checked(result, "read " + path);
    return out;
  }
  const size_t size = H5Tget_size(type);
  if (size == 0 || size > (size_t{1} << 20)) refuse(path, "has texts of a strange length");
  std::string all(size * count, '\0');
  checked(read(type, all.data()), "read " + path);
  for (size_t i = 0; i < count; ++i) {
    const std::string text = all.substr(i * size, size);
    out.push_back(text.substr(0, text.find('\0')));
  }
  return out;
}

Id root_attribute(const File& file, const std::string& name) {
  return Id(H5Aopen(file.id(), name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
}

void check_single(hid_t attribute, const std::string& name) {
  const Id space(H5Aget_space(attribute), H5Sclose, "measure attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1) refuse("attribute " + name, "is not one value");
}

}  // namespace

template <typename T>
NumberColumn<T>::NumberColumn(const File& file, const std::string& path, std::vector<hsize_t> inner)
    : path_(path),
      dataset_(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + path),
      space_(H5Dget_space(dataset_), H5Sclose, "measure " + path),
      shape_(limited_dimensions_of(space_, path)) {
  const Id type(H5Dget_type(dataset_), H5Tclose, "find the type of " + path);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) refuse(path, "holds no numbers");
  if (std::is_integral_v<T> && kind != H5T_INTEGER) refuse(path, "holds no whole numbers");
  bool fits = shape_.size() == inner.size() + 1;
  for (size_t i = 0; fits && i < inner.size(); ++i) fits = inner[i] == 0 || shape_[i + 1] == inner[i];
  if (!fits) refuse(path, "has another shape than that of this format");
  for (size_t i = 1; i < shape_.size(); ++i) row_values_ *= shape_[i];
  check_stored(dataset_, path);
}

template <typename T>
void NumberColumn<T>::check_rows(hsize_t first, hsize_t count) const {
  if (first > rows() || count > rows() - first)
    refuse(path_, fmt::format("has {} rows, not {} from {} on", rows(), count, first));
}

template <typename T>
std::vector<T> NumberColumn<T>::read(hsize_t first, hsize_t count) const {
  check_rows(first, count);
  std::vector<T> out(count * row_values_);
  if (out.empty()) return out;
  std::vector<hsize_t> start(shape_.size(), 0), block = shape_;
  start[0] = first;
  block[0] = count;
  const Id selected(H5Scopy(space_), H5Sclose, "select rows of " + path_);
  checked(H5Sselect_hyperslab(selected, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
          "select rows of " + path_);
  const Id memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose, "make a space");
  checked(H5Dread(dataset_, Type<T>::memory(), memory, selected, H5P_DEFAULT, out.data()), "read " + path_);
  return out;
}

template class NumberColumn<uint8_t>;
template class NumberColumn<uint32_t>;
template class NumberColumn<uint64_t>;
template class NumberColumn<double>;

std::vector<std::string> read_strings(const File& file, const std::string& path) {
  const Id dataset(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + path);
  const Id space(H5Dget_space(dataset), H5Sclose, "measure " + path);
  const std::vector<hsize_t> shape = limited_dimensions_of(space, path);
  if (shape.size() != 1 || shape[0] > most_strings) refuse(path, "has another shape than that of this format");
  const Id type(H5Dget_type(dataset), H5Tclose, "find the type of " + path);
  check_stored(dataset, path);
  return strings_of(type, shape[0], path, [&](hid_t memory, void* out) {
    return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
  });
}

std::string root_text(const File& file, const std::string& name) {
  const Id attribute = root_attribute(file, name);
  check_single(attribute, name);
  const Id type(H5Aget_type(attribute), H5Tclose, "find the type of attribute " + name);
  return strings_of(type, 1, "attribute " + name,
                    [&](hid_t memory, void* out) { return H5Aread(attribute, memory, out); })[0];
}

double root_number(const File& file, const std::string& name) {
  const Id attribute = root_attribute(file, name);
  check_single(attribute, name);
  const Id type(H5Aget_type(attribute), H5Tclose, "find the type of attribute " + name);
  if (H5Tget_class(type) != H5T_FLOAT && H5Tget_class(type) != H5T_INTEGER)
    refuse("attribute " + name, "is not a number");
  double value = 0;
  checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "read attribute " + name);
  return value;
}

}  // namespace wavetracer::hdf5
