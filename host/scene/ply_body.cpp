// SPDX-License-Identifier: Apache-2.0
// Numbers of ascii files are separated by blanks of any kind, including line ends.
#include "scene/ply_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "wavetracer/error.hpp"

namespace wavetracer::ply {

void PlyBody::begin(const Element& element) {
  element_ = &element;
  index_ = 0;
  uint64_t least = 0;  // least number of bytes of an entry; a number in ascii needs a digit and a separator
  for (const Property& p : element.properties) {
    least += format_ == Format::ascii ? 2 : size_of(p.count ? *p.count : p.type);
  }
  const uint64_t left = static_cast<uint64_t>(end_ - next_) + 1;  // the last separator of an ascii file may be absent
  if (least > 0 && element.count > left / least) {
    throw InputError(
        fmt::format("{}: the header declares {} entries of element '{}', at least {} bytes each, "
                    "but only {} bytes are left: the file is incomplete or its header is wrong",
                    file_, element.count, element.name, least, left - 1));
  }
}

size_t PlyBody::left() const {
  const char* const next = format_ == Format::ascii ? std::find_if_not(next_, end_, is_space) : next_;
  return static_cast<size_t>(end_ - next);
}

template <class T>
T PlyBody::raw() {
  if (static_cast<size_t>(end_ - next_) < sizeof(T)) fail("the file ends here: it is incomplete");
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), next_, sizeof(T));
  next_ += sizeof(T);
  const bool host_little = std::endian::native == std::endian::little;
  if ((format_ == Format::little) != host_little) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

double PlyBody::word(Type type) {
  while (next_ < end_ && is_space(*next_)) ++next_;
  if (next_ == end_) fail("the file ends here: it is incomplete");
  const char* begin = next_;
  while (next_ < end_ && !is_space(*next_)) ++next_;
  const std::string_view text(begin, static_cast<size_t>(next_ - begin));
  if (*begin == '+') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, next_, value);
  const bool whole = type >= Type::f32 || value == std::floor(value);
  if (error != std::errc() || stop != next_ || !whole) {
    fail(fmt::format("'{}' is not a{} number", text, type >= Type::f32 ? "" : " whole"));
  }
  return value;
}

double PlyBody::scalar(Type type) {
  if (format_ == Format::ascii) return word(type);
  switch (type) {
    case Type::i8:
      return raw<int8_t>();
    case Type::u8:
      return raw<uint8_t>();
    case Type::i16:
      return raw<int16_t>();
    case Type::u16:
      return raw<uint16_t>();
    case Type::i32:
      return raw<int32_t>();
    case Type::u32:
      return raw<uint32_t>();
    case Type::f32:
      return static_cast<double>(raw<float>());
    case Type::f64:
      break;
  }
  return raw<double>();
}

size_t PlyBody::length(const Property& property) {
  const double n = scalar(*property.count);
  const size_t bytes = format_ == Format::ascii ? 1 : size_of(property.type);
  if (!(n >= 0) || n * static_cast<double>(bytes) > static_cast<double>(end_ - next_)) {
    fail(fmt::format("property '{}' has the length {}, which is more than the file contains", property.name, n));
  }
  return static_cast<size_t>(n);
}

void PlyBody::skip(const Property& property) {
  size_t n = property.count ? length(property) : 1;
  while (n-- > 0) scalar(property.type);
}

void PlyBody::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {} {} of {}: {}", file_, element_->name, index_, element_->count, what));
}

}  // namespace wavetracer::ply
