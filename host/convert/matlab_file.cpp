// SPDX-License-Identifier: Apache-2.0
// The layout that MATLAB's save -v7.3 writes: MATLAB_class on every object, MATLAB_empty on arrays without elements,
// cells as references into /#refs#. Assumes that names are valid in MATLAB.
#include "convert/matlab_file.hpp"
#include <algorithm>
#include <cstring>
#include "base/unicode.hpp"

namespace wavetracer {
namespace {

using hdf5::checked;
using hdf5::Id;

constexpr hsize_t header_bytes = 512;

Id new_file() {
  constexpr size_t growth_bytes = size_t{1} << 20;
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up a file in memory");
  checked(H5Pset_fapl_core(access, growth_bytes, /*backing_store=*/0), "set up a file in memory");
  const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "set up a file in memory");
  checked(H5Pset_userblock(creation, header_bytes), "leave room for MATLAB's header");
  return Id(H5Fcreate("in memory", H5F_ACC_TRUNC, creation, access), H5Fclose, "create a file in memory");
}

Id fixed_text(size_t bytes) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a string type");
  checked(H5Tset_size(type, bytes), "make a string type");
  return type;
}

void attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type, const void* value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a data space");
  const Id made(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                std::string("create attribute ") + name);
  checked(H5Awrite(made, memory_type, value), std::string("write attribute ") + name);
}

void name_class(hid_t object, const char* type_name) {
  const Id type = fixed_text(std::strlen(type_name));
  attribute(object, "MATLAB_class", type, type, type_name);
}

Id complex_type(hid_t part) {
  Id type(H5Tcreate(H5T_COMPOUND, 2 * sizeof(double)), H5Tclose, "make a complex type");
  checked(H5Tinsert(type, "real", 0, part), "make a complex type");
  checked(H5Tinsert(type, "imag", sizeof(double), part), "make a complex type");
  return type;
}

}  // namespace

MatlabFile::MatlabFile() : file_(new_file()) {}

void MatlabFile::add_struct(const std::string& path) {
  const Id group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                 "create group " + path);
  name_class(group, "struct");
}

// The dataset of an array without elements holds its shape.
void MatlabFile::write(const std::string& path, const char* type_name, hid_t file_type, hid_t memory_type,
                       const Shape& shape, const void* values, bool text) {
  const bool empty = std::ranges::count(shape, hsize_t{0}) > 0;
  const Shape dimensions = empty ? Shape{shape.size()} : Shape(shape.rbegin(), shape.rend());
  const Id space(H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr), H5Sclose,
                 "make a data space");
  const Id dataset(H5Dcreate2(file_, path.c_str(), empty ? H5T_STD_U64LE : file_type, space, H5P_DEFAULT,
                              hdf5::untimed(), H5P_DEFAULT),
                   H5Dclose, "create dataset " + path);
  checked(H5Dwrite(dataset, empty ? H5T_NATIVE_HSIZE : memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                   empty ? shape.data() : values),
          "write " + path);
  name_class(dataset, type_name);
  if (text) {
    const int32_t utf16_code = 2;
    attribute(dataset, "MATLAB_int_decode", H5T_STD_I32LE, H5T_NATIVE_INT32, &utf16_code);
  }
  if (empty) {
    const uint8_t yes = 1;
    attribute(dataset, "MATLAB_empty", H5T_STD_U8LE, H5T_NATIVE_UINT8, &yes);
  }
}

void MatlabFile::add(const std::string& path, const Shape& shape, std::span<const double> values) {
  write(path, "double", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, shape, values.data());
}

void MatlabFile::add(const std::string& path, const Shape& shape, std::span<const uint32_t> values) {
  write(path, "uint32", H5T_STD_U32LE, H5T_NATIVE_UINT32, shape, values.data());
}

void MatlabFile::add(const std::string& path, const Shape& shape, std::span<const uint8_t> values) {
  write(path, "uint8", H5T_STD_U8LE, H5T_NATIVE_UINT8, shape, values.data());
}

void MatlabFile::add(const std::string& path, const Shape& shape, std::span<const std::complex<double>> values) {
  write(path, "double", complex_type(H5T_IEEE_F64LE), complex_type(H5T_NATIVE_DOUBLE), shape, values.data());
}

void MatlabFile::add_text(const std::string& path, const std::string& text) {
  const std::u16string codes = utf16(text);
  const Shape shape = codes.empty() ? Shape{0, 0} : Shape{1, codes.size()};
  write(path, "char", H5T_STD_U16LE, H5T_NATIVE_UINT16, shape, codes.data(), true);
}

void MatlabFile::add_texts(const std::string& path, const std::vector<std::string>& texts) {
  if (texts_.empty() && !texts.empty())
    const Id group(H5Gcreate2(file_, "/#refs#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create /#refs#");
  std::vector<hobj_ref_t> references(texts.size());
  for (size_t i = 0; i < texts.size(); ++i) {
    const auto [known, fresh] = texts_.try_emplace(texts[i]);
    if (fresh) {
      const std::string target = "/#refs#/text" + std::to_string(texts_.size() - 1);
      add_text(target, texts[i]);
      checked(H5Rcreate(&known->second, file_, target.c_str(), H5R_OBJECT, -1), "refer to " + target);
    }
    references[i] = known->second;
  }
  write(path, "cell", H5T_STD_REF_OBJ, H5T_STD_REF_OBJ, {texts.size(), 1}, references.data());
}

std::vector<std::byte> MatlabFile::image(const std::string& description) const {
  checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "finish a file in memory");
  // HDF5 counts and copies the bytes after the user block.
  const ssize_t bytes = H5Fget_file_image(file_, nullptr, 0);
  checked(bytes < 0 ? -1 : 0, "finish a file in memory");
  std::vector<std::byte> out(header_bytes + static_cast<size_t>(bytes));
  checked(H5Fget_file_image(file_, out.data() + header_bytes, static_cast<size_t>(bytes)) < 0 ? -1 : 0,
          "finish a file in memory");
  // The header has 116 bytes of text, 8 of an offset that 7.3 does not use, version 2.0, and the byte order.
  std::string header = ("MATLAB 7.3 MAT-file, " + description).substr(0, 116);
  header.resize(116, ' ');
  header += std::string(8, '\0') + std::string("\0\x02IM", 4);
  std::memcpy(out.data(), header.data(), header.size());
  return out;
}

}  // namespace wavetracer
