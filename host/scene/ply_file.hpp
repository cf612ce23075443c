// SPDX-License-Identifier: Apache-2.0
// A PLY file: its header, which says which elements the body holds, in which order and types, and the values of the
// body, in file order. It assumes IEEE 754 numbers on a little or big endian host, and nothing about the text: every
// access is bounds checked, and every line that is not understood is an error with its number.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer::ply {

enum class Format { ascii, little, big };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> count;  // set for lists: the type of the length
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  size_t size = 0;  // bytes, up to and including the line end_header
};

size_t size_of(Type type);
bool is_space(char c);

// Throws InputError that names the file and the line.
Header parse_header(std::string_view content, const std::string& file);

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
