// SPDX-License-Identifier: Apache-2.0
// Writes NumPy's format 1.0 (base/npy.hpp) inside PKWARE's zip (APPNOTE 6.3). Entries are deflated at the fastest
// level, since many arrays are mostly padding.
#include "convert/npz.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>
#include <bit>
#include <limits>
#include <new>
#include "base/npy.hpp"
#include "base/unicode.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns both parts as one raw deflate stream.
std::string deflated(std::span<const std::byte> head, std::span<const std::byte> body) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out;
  std::vector<Bytef> chunk(size_t{1} << 18);
  const auto feed = [&](std::span<const std::byte> bytes, int flush) {
    // zlib does not write to its input, but declares that only if ZLIB_CONST is defined.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    do {
      stream.next_out = chunk.data();
      stream.avail_out = static_cast<uInt>(chunk.size());
      deflate(&stream, flush);
      out.append(reinterpret_cast<const char*>(chunk.data()), chunk.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  };
  feed(head, Z_NO_FLUSH);
  feed(body, Z_FINISH);
  deflateEnd(&stream);
  return out;
}

// The fields that an entry's own header and the directory share. 20: needs version 2.0; 0x800: names are UTF-8; 8:
// deflated. The date is the first day of the format, so that files are the same whenever they are written.
std::string common_fields(uint32_t checksum, uint32_t stored_bytes, uint32_t bytes, size_t name_bytes) {
  std::string out;
  for (const int field : {20, 0x800, 8, 0, 0x21}) put(out, static_cast<uint16_t>(field));
  for (const uint32_t field : {checksum, stored_bytes, bytes}) put(out, field);
  put(out, static_cast<uint16_t>(name_bytes));
  put(out, uint16_t{0});  // no extra field
  return out;
}

}  // namespace

void Npz::write(const std::string& bytes) {
  sink_(std::as_bytes(std::span(bytes)));
  offset_ += bytes.size();
}

void Npz::add_array(const std::string& name, const std::string& type, const Shape& shape,
                    std::span<const std::byte> values) {
  const std::string header = npy_header(type, shape);
  const std::span<const std::byte> head = std::as_bytes(std::span(header));
  total_bytes_ += head.size() + values.size();
  if (entries_.size() == std::numeric_limits<uint16_t>::max())
    throw RuntimeError(fmt::format("more than {} arrays in one .npz", entries_.size()));
  if (total_bytes_ > npz_limit_bytes)
    throw RuntimeError(fmt::format("arrays of more than {:.3g} GB; choose fewer frames with --frames",
                                   static_cast<double>(npz_limit_bytes) / 1e9));
  const std::string body = deflated(head, values);
  const auto crc = [](uLong sum, std::span<const std::byte> bytes) {
    // With a null pointer, crc32_z() would reset the sum.
    return bytes.empty() ? sum : crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  };
  Entry entry{name + ".npy", static_cast<uint32_t>(crc(crc(0, head), values)), static_cast<uint32_t>(body.size()),
              static_cast<uint32_t>(head.size() + values.size()), static_cast<uint32_t>(offset_)};
  std::string local("PK\x03\x04");
  local += common_fields(entry.checksum, entry.stored_bytes, entry.bytes, entry.name.size()) + entry.name;
  write(local);
  write(body);
  entries_.push_back(std::move(entry));
}

void Npz::finish() {
  std::string directory;
  for (const Entry& entry : entries_) {
    directory += "PK\x01\x02";
    put(directory, uint16_t{20});
    directory += common_fields(entry.checksum, entry.stored_bytes, entry.bytes, entry.name.size());
    for (int i = 0; i < 3; ++i) put(directory, uint16_t{0});  // no comment, the first disk, a binary file
    put(directory, uint32_t{0});
    put(directory, entry.offset);
    directory += entry.name;
  }
  const auto start = static_cast<uint32_t>(offset_), bytes = static_cast<uint32_t>(directory.size());
  const auto count = static_cast<uint16_t>(entries_.size());
  directory += "PK\x05\x06";
  for (const uint16_t field : {uint16_t{0}, uint16_t{0}, count, count}) put(directory, field);
  put(directory, bytes);
  put(directory, start);
  put(directory, uint16_t{0});
  write(directory);
}

void Npz::add(const std::string& name, const Shape& shape, std::span<const double> values) {
  add_array(name, "<f8", shape, std::as_bytes(values));
}

void Npz::add(const std::string& name, const Shape& shape, std::span<const uint32_t> values) {
  add_array(name, "<u4", shape, std::as_bytes(values));
}

void Npz::add_flags(const std::string& name, const Shape& shape, std::span<const uint8_t> values) {
  add_array(name, "|b1", shape, std::as_bytes(values));
}

// Texts are padded with zeros to one length, with four bytes per character.
void Npz::add_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::u32string> decoded;
  size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, decoded.emplace_back(utf32(text)).size());
  std::u32string cells;
  for (std::u32string& text : decoded) {
    text.resize(length);
    cells += text;
  }
  add_array(name, fmt::format("<U{}", length), {texts.size()}, std::as_bytes(std::span(cells)));
}

void Npz::add_text(const std::string& name, const std::string& text) {
  const std::u32string decoded = utf32(text);
  add_array(name, fmt::format("<U{}", decoded.size()), {}, std::as_bytes(std::span(decoded)));
}

}  // namespace wavetracer
