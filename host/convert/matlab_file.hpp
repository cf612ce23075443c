// SPDX-License-Identifier: Apache-2.0
// Writes MATLAB's file format 7.3: HDF5 after a 512-byte header, with attributes that give the class of a dataset.
// Dimensions are given as in MATLAB, and values in its order, the first index fastest; HDF5 lists them in reverse.
#pragma once
#include <complex>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>
#include "output/hdf5.hpp"

namespace wavetracer {

class MatlabFile {
 public:
  using Shape = std::vector<hsize_t>;

  MatlabFile();  // an empty file, in memory

  // path: such as "/run/paths/delay_s"; its parents are structs that were added before. Throws RuntimeError.
  void add_struct(const std::string& path);
  void add(const std::string& path, const Shape& shape, std::span<const double> values);
  void add(const std::string& path, const Shape& shape, std::span<const uint32_t> values);
  void add(const std::string& path, const Shape& shape, std::span<const uint8_t> values);
  void add(const std::string& path, const Shape& shape, std::span<const std::complex<double>> values);
  void add_text(const std::string& path, const std::string& text);  // UTF-8; stored as a row of characters
  void add_texts(const std::string& path, const std::vector<std::string>& texts);  // stored as a cell column

  // Returns the bytes of the file. description: a line for people at the start of the file.
  std::vector<std::byte> image(const std::string& description) const;

 private:
  void write(const std::string& path, const char* type_name, hid_t file_type, hid_t memory_type, const Shape& shape,
             const void* values, bool text = false);

  hdf5::Silence silence_;
  hdf5::Id file_;
  std::map<std::string, hobj_ref_t> texts_;  // in /#refs#, each text once: a run has few antennas and many ends
};

}  // namespace wavetracer
