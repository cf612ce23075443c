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
  // The entry of the element that is read next, for messages.
  void at(uint64_t index) { index_ = index; }
  // Bytes that no element has taken; blanks before them are none in an ascii file.
  size_t left() const;

  double scalar(Type type);
  // The length of a list, checked against what is left of the file.
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
