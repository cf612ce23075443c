// SPDX-License-Identifier: Apache-2.0
// Reads datasets of a file that is not trusted: shapes and types are checked before memory is allocated for them.
// The library crashes on some damaged files in spite of all checks, so this runs in a child process (foreign_file.hpp).
// Throws RuntimeError with the dataset's path and what is wrong with it.
#pragma once
#include <string>
#include <vector>
#include "output/hdf5.hpp"

namespace wavetracer::hdf5 {

// A dataset of numbers, (rows, inner...), converted to T when it is read.
template <typename T>
class NumberColumn {
 public:
  // inner: the sizes of all dimensions but the first; 0 stands for any size.
  NumberColumn(const File& file, const std::string& path, std::vector<hsize_t> inner = {});
  hsize_t rows() const { return shape_[0]; }
  const std::vector<hsize_t>& shape() const { return shape_; }
  hsize_t row_values() const { return row_values_; }
  void check_rows(hsize_t first, hsize_t count) const;
  // Reads whole rows, which must exist.
  std::vector<T> read(hsize_t first, hsize_t count) const;

 private:
  std::string path_;
  Id dataset_, space_;
  std::vector<hsize_t> shape_;
  hsize_t row_values_ = 1;
};

// Reads a dataset of texts in one dimension.
std::vector<std::string> read_strings(const File& file, const std::string& path);

// Read attributes of the root. A missing one, or one of another type or shape, is an error.
std::string root_text(const File& file, const std::string& name);
double root_number(const File& file, const std::string& name);

}  // namespace wavetracer::hdf5
