// MATLAB's file format 7.3: HDF5 behind a 512-byte header, with attributes that say what class a dataset is.
// Dimensions are given as MATLAB has them, values in its order, the first index fastest; HDF5 lists them the other way.
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

  MatlabFile();  // empty, in memory

  // path: "/run/paths/delay_s", whose parents are structs made before it. Throws RuntimeError.
  void add_struct(const std::string& path);
  void add(const std::string& path, const Shape& shape, std::span<const double> values);
  void add(const std::string& path, const Shape& shape, std::span<const uint32_t> values);
  void add(const std::string& path, const Shape& shape, std::span<const uint8_t> values);
  void add(const std::string& path, const Shape& shape, std::span<const std::complex<double>> values);
  void add_text(const std::string& path, const std::string& text);                 // UTF-8; a row of characters
  void add_texts(const std::string& path, const std::vector<std::string>& texts);  // a cell column

  // What the file on disk must hold. description: a line for people, at the very front.
  std::vector<std::byte> image(const std::string& description) const;

 private:
  void write(const std::string& path, const char* type_name, hid_t file_type, hid_t memory_type, const Shape& shape,
             const void* values, bool text = false);

  hdf5::Silence silence_;
  hdf5::Id file_;
  std::map<std::string, hobj_ref_t> texts_;  // in /#refs#, each once: a run has few antennas and many ends
};

}  // namespace wavetracer
