// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file: which elements the body holds, in which order and types.
// Assumes nothing about the text: every line that is not understood is an error with its number.
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

}  // namespace wavetracer::ply
