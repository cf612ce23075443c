// SPDX-License-Identifier: Apache-2.0
// Damages HDF5 files of runs so that they stay well formed except for one thing.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "output/hdf5.hpp"

namespace wavetracer::test {

template <typename T>
void overwrite(const std::filesystem::path& path, const std::string& dataset, hsize_t index, T value) {
  const hdf5::File file = hdf5::File::open_to_write(path);
  const hdf5::Column column(file, dataset);
  const hdf5::Id id(H5Dopen2(file.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose, "open");
  hsize_t size = column.shape()[0];
  for (size_t i = 1; i < column.shape().size(); ++i) size *= column.shape()[i];
  std::vector<T> values(size);
  hdf5::checked(H5Dread(id, hdf5::Type<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read");
  values.at(index) = value;
  hdf5::checked(H5Dwrite(id, hdf5::Type<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write");
}

inline void remove_member(const std::filesystem::path& path, const std::string& member) {
  const hdf5::File file = hdf5::File::open_to_write(path);
  hdf5::checked(H5Ldelete(file.id(), member.c_str(), H5P_DEFAULT), "delete");
}

}  // namespace wavetracer::test
