// SPDX-License-Identifier: Apache-2.0
// Reads an HDF5 file that is not trusted: a child process opens and reads it (limited_child.hpp), so a file that
// crashes the library ends the child, not this process.
// Every function throws RuntimeError with the dataset's path and what is wrong with it, or InputError that names the
// file if the library crashes or takes more memory or time than a file of ours may.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace wavetracer::hdf5 {

class ForeignFile {
 public:
  // The first request opens the file.
  explicit ForeignFile(const std::filesystem::path& path);
  ~ForeignFile();
  ForeignFile(ForeignFile&&) noexcept;

  // Tells whether a group of the root exists.
  bool has(const std::string& group) const;
  // Returns the size of each dimension. inner: the sizes of all dimensions but the first; 0 stands for any size.
  std::vector<uint64_t> shape(const std::string& dataset, const std::vector<uint64_t>& inner = {}) const;
  // Reads whole rows, which must exist, as numbers of the type T.
  template <typename T>
  std::vector<T> rows(const std::string& dataset, uint64_t first, uint64_t count,
                      const std::vector<uint64_t>& inner = {}) const;
  template <typename T>
  std::vector<T> all_rows(const std::string& dataset, const std::vector<uint64_t>& inner = {}) const;
  // Reads a dataset of texts in one dimension.
  std::vector<std::string> strings(const std::string& dataset) const;
  // Read attributes of the root.
  std::string root_text(const std::string& name) const;
  double root_number(const std::string& name) const;

 private:
  struct Child;
  std::unique_ptr<Child> child_;
};

}  // namespace wavetracer::hdf5
