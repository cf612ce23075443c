// SPDX-License-Identifier: Apache-2.0
// Reads chunks through zlib, whose gz functions pass plain files through unchanged.
// zlib verifies the length of a gzip stream and its checksum.
#include "motion/byte_stream.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>

#include "base/input_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr unsigned chunk_bytes = 1u << 16;
// gzip shrinks repeated text to a thousandth, trajectories to a tenth, and trajectories of standing vehicles to a
// hundredth.
constexpr uint64_t most_unpacked = 300, free_bytes = uint64_t{64} << 20;

}  // namespace

struct ByteStream::Handle {
  gzFile stream;
  ~Handle() { gzclose(stream); }
};

ByteStream::ByteStream(const std::filesystem::path& path, const char* what)
    : file_(path.string()), what_(what), chunk_(chunk_bytes, '\0') {
  check_input_file(path, fmt::format("the {}", what).c_str());
  most_bytes_ = free_bytes + most_unpacked * std::filesystem::file_size(path);
  errno = 0;
  const gzFile stream = gzopen(path.c_str(), "rb");
  if (!stream) throw InputError(fmt::format("{}: cannot be opened: {}", file_, std::strerror(errno)));
  handle_.reset(new Handle{stream});
}

ByteStream::~ByteStream() = default;

std::string_view ByteStream::peek() {
  const std::string_view chunk = next();
  peeked_ = true;
  return chunk;
}

std::string_view ByteStream::next() {
  if (!peeked_) {
    const int count = gzread(handle_->stream, chunk_.data(), chunk_bytes);
    size_ = count > 0 ? static_cast<size_t>(count) : 0;
    if ((bytes_ += size_) > most_bytes_) {
      throw InputError(
          fmt::format("{}: unpacks to more than {} times its {} bytes, which is too much for a {}; "
                      "unpack it and look at its content",
                      file_, most_unpacked, (most_bytes_ - free_bytes) / most_unpacked, what_));
    }
    int error = Z_OK;
    const char* const reason = gzerror(handle_->stream, &error);
    if (error == Z_BUF_ERROR) {
      throw InputError(fmt::format(
          "{}: the gzip stream ends too early, after {} bytes of text: copy the file again, or let its writer finish",
          file_, gztell(handle_->stream)));
    }
    if (count < 0 || (error != Z_OK && error != Z_STREAM_END)) {
      throw InputError(fmt::format("{}: cannot be read after {} bytes of text: {}; copy the file again", file_,
                                   gztell(handle_->stream), error == Z_ERRNO ? std::strerror(errno) : reason));
    }
  }
  peeked_ = false;
  return {chunk_.data(), size_};
}

}  // namespace wavetracer
