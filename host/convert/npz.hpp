// SPDX-License-Identifier: Apache-2.0
// Writes NumPy's .npz: a zip archive of arrays in C order, one array after the other.
// The machine must be little-endian; an archive stays below 4 GiB, so that it needs no extension of the zip format.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace wavetracer {

// Largest uncompressed size of an archive; this leaves room for names and headers.
constexpr uint64_t npz_limit_bytes = uint64_t{4'000'000'000};

class Npz {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;  // a function that appends bytes to the file
  using Shape = std::vector<size_t>;

  explicit Npz(Sink sink) : sink_(std::move(sink)) {}

  // values: their number is the product of the shape. Throws RuntimeError beyond npz_limit_bytes.
  void add(const std::string& name, const Shape& shape, std::span<const double> values);
  void add(const std::string& name, const Shape& shape, std::span<const uint32_t> values);
  // Values are 0 or 1, and are read as bool.
  void add_flags(const std::string& name, const Shape& shape, std::span<const uint8_t> values);
  void add_number(const std::string& name, double value) { add(name, {}, std::span<const double>(&value, 1)); }
  void add_texts(const std::string& name, const std::vector<std::string>& texts);  // UTF-8
  void add_text(const std::string& name, const std::string& text);

  // Writes the directory of the archive; no array may be added after it.
  void finish();

 private:
  struct Entry {
    std::string name;
    uint32_t checksum, stored_bytes, bytes, offset;
  };
  void add_array(const std::string& name, const std::string& type, const Shape& shape,
                 std::span<const std::byte> values);
  void write(const std::string& bytes);

  Sink sink_;
  std::vector<Entry> entries_;
  uint64_t offset_ = 0, total_bytes_ = 0;
};

}  // namespace wavetracer
