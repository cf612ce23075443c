// SPDX-License-Identifier: Apache-2.0
// The header is read after G. Turk, "The PLY polygon file format" (1994), with the type names that later tools added
// (int8, float32, ...). Its lines end in \n or \r\n.
#include "scene/ply_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "wavetracer/error.hpp"

namespace wavetracer::ply {
namespace {

std::optional<Type> type_named(std::string_view name) {
  struct Named {
    std::string_view turk, sized;
    Type type;
  };
  constexpr Named names[] = {{"char", "int8", Type::i8},      {"uchar", "uint8", Type::u8},
                             {"short", "int16", Type::i16},   {"ushort", "uint16", Type::u16},
                             {"int", "int32", Type::i32},     {"uint", "uint32", Type::u32},
                             {"float", "float32", Type::f32}, {"double", "float64", Type::f64}};
  for (const Named& n : names) {
    if (name == n.turk || name == n.sized) return n.type;
  }
  return std::nullopt;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> out;
  for (size_t i = 0; i < line.size();) {
    while (i < line.size() && is_space(line[i])) ++i;
    const size_t begin = i;
    while (i < line.size() && !is_space(line[i])) ++i;
    if (i > begin) out.push_back(line.substr(begin, i - begin));
  }
  return out;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view content, const std::string& file) : content_(content), file_(file) {}

  Header parse() {
    if (next_line() != "ply") fail("not a PLY file: its first line must be 'ply'");
    while (true) {
      const std::string_view line = next_line();
      const auto word = words(line);
      if (word.empty() || word[0] == "comment" || word[0] == "obj_info") continue;
      if (word[0] == "end_header") break;
      if (word[0] == "format") {
        set_format(word);
      } else if (word[0] == "element") {
        add_element(word);
      } else if (word[0] == "property") {
        add_property(word);
      } else {
        fail(fmt::format("unknown header word '{}'", word[0]));
      }
    }
    if (!has_format_) fail("the header has no 'format' line");
    header_.size = position_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_, what));
  }

  std::string_view next_line() {
    const size_t end = content_.find('\n', position_);
    ++line_;
    if (end == std::string_view::npos)
      fail("the PLY header has no 'end_header': the file is incomplete, or it is not a PLY file");
    std::string_view line = content_.substr(position_, end - position_);
    position_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void set_format(const std::vector<std::string_view>& word) {
    const std::string_view name = word.size() > 1 ? word[1] : std::string_view();
    if (name == "ascii") {
      header_.format = Format::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = Format::little;
    } else if (name == "binary_big_endian") {
      header_.format = Format::big;
    } else {
      fail(fmt::format("unknown PLY format '{}'; known: ascii, binary_little_endian, binary_big_endian", name));
    }
    if (word.size() > 2 && word[2] != "1.0") fail(fmt::format("PLY of version {} is not known; known: 1.0", word[2]));
    has_format_ = true;
  }

  void add_element(const std::vector<std::string_view>& word) {
    Element element;
    if (word.size() != 3) fail("an element line must be 'element NAME COUNT'");
    element.name = word[1];
    const auto [end, error] = std::from_chars(word[2].data(), word[2].data() + word[2].size(), element.count);
    if (error != std::errc() || end != word[2].data() + word[2].size()) {
      fail(fmt::format("element '{}' has the count '{}', which is not an integer", word[1], word[2]));
    }
    header_.elements.push_back(std::move(element));
  }

  void add_property(const std::vector<std::string_view>& word) {
    if (header_.elements.empty()) fail("a property comes before the first element");
    const bool list = word.size() == 5 && word[1] == "list";
    if (!list && word.size() != 3)
      fail("a property line must be 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    Property property;
    property.name = word.back();
    property.type = type(word[list ? 3 : 1]);
    if (list) property.count = type(word[2]);
    if (property.count && *property.count >= Type::f32) fail("the length of a list must have an integer type");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type type(std::string_view name) const {
    const auto found = type_named(name);
    if (!found) fail(fmt::format("unknown property type '{}'", name));
    return *found;
  }

  std::string_view content_;
  const std::string& file_;
  Header header_;
  bool has_format_ = false;
  size_t position_ = 0, line_ = 0;
};

}  // namespace

size_t size_of(Type type) {
  constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

Header parse_header(std::string_view content, const std::string& file) { return HeaderParser(content, file).parse(); }

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
