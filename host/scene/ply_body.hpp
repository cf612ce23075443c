// SPDX-License-Identifier: Apache-2.0
// The body of a PLY file: the values after its header, in file order.
// Assumes IEEE 754 numbers on a little or big endian host; every access to the file is bounds checked.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/ply_header.hpp"

namespace wavetracer::ply {

class PlyBody {
 public:
  PlyBody(std::string_view bytes, Format format, const std::string& file)
      : next_(bytes.data()), end_(bytes.data() + bytes.size()), format_(format), file_(file) {}

  // Starts an element; refuses counts that the rest of the file cannot hold.
  void begin(const Element& element);
  // Sets the entry of the element that is read next, for messages.
  void at(uint64_t index) { index_ = index; }
  // Returns the number of bytes that no element has taken; in an ascii file leading blanks do not count.
  size_t left() const;

  double scalar(Type type);
  // Reads the length of a list, and checks it against the rest of the file.
  size_t length(const Property& property);
  void skip(const Property& property);

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class T>
  T raw();
  double word(Type type);

  const char* next_;
  const char* end_;
  Format format_;
  const std::string& file_;
  const Element* element_ = nullptr;
  uint64_t index_ = 0;
};

}  // namespace wavetracer::ply
