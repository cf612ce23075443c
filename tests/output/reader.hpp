// SPDX-License-Identifier: Apache-2.0
// Reads HDF5 files with plain calls of the C library, so that a fault of the project's own wrapper cannot hide itself.
// Assumes that what is asked for is there.
#pragma once
#include <doctest/doctest.h>
#include <hdf5.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace wavetracer::test {

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Another byte at this place of the file.
inline void change_byte(const std::filesystem::path& path, uint64_t at) {
  std::fstream bytes(path, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(bytes.get() ^ 1);
  bytes.seekp(static_cast<std::streamoff>(at));
  bytes.put(byte);
}

struct Reader {
  hid_t file;
  explicit Reader(const std::filesystem::path& path) : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Reader() { H5Fclose(file); }

  std::vector<hsize_t> shape(const char* name) const {
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    std::vector<hsize_t> result(static_cast<size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.data(), nullptr);
    H5Sclose(space);
    H5Dclose(dataset);
    return result;
  }
  std::vector<double> numbers(const char* name) const {  // the library converts integers exactly up to 2^53
    size_t count = 1;
    for (const hsize_t n : shape(name)) count *= n;
    std::vector<double> result(count);
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    CHECK(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()) >= 0);
    H5Dclose(dataset);
    return result;
  }
  std::string attribute(const char* object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT),
                type = H5Aget_type(attribute);
    char* text = nullptr;
    CHECK(H5Aread(attribute, type, &text) >= 0);
    const std::string result = text ? text : "";
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
  }
};

// Path of every dataset with its type, shape, bytes and meaning.
inline std::map<std::string, std::string> datasets(const std::filesystem::path& path) {
  const Reader h5(path);
  std::map<std::string, std::string> out;
  const auto visit = [](hid_t file, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set), space = H5Dget_space(set);
    hsize_t shape[4] = {};
    const int rank = H5Sget_simple_extent_dims(space, shape, nullptr);
    std::string value = std::to_string(H5Tget_class(type)) + ":" + std::to_string(H5Tget_size(type));
    for (int i = 0; i < rank; ++i) value += "," + std::to_string(shape[i]);
    const size_t count = static_cast<size_t>(H5Sget_simple_extent_npoints(space));
    if (H5Tis_variable_str(type) > 0) {
      std::vector<char*> texts(count);
      H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
      for (char* text : texts) {
        value += std::string("|") + text;
        H5free_memory(text);
      }
    } else {
      std::string bytes(count * H5Tget_size(type), '\0');
      H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
      value += "|" + bytes;
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
    (*static_cast<std::map<std::string, std::string>*>(data))[name] = value;
    return 0;
  };
  H5Ovisit(h5.file, H5_INDEX_NAME, H5_ITER_INC, visit, &out);
  for (auto& [name, value] : out)
    value += "|" + h5.attribute(name.c_str(), "units") + "|" + h5.attribute(name.c_str(), "description");
  return out;
}

}  // namespace wavetracer::test
