// SPDX-License-Identifier: Apache-2.0
// Implements FNV-1a of 128 bits, a fold by splitmix64, and XXH64.
// It assumes a compiler with 128-bit integers (GCC, Clang) and a little-endian machine, as all OpenCL hosts here are.
#include "base/hash.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

namespace wavetracer {
namespace {

// The names and values are those of the specification.
constexpr uint64_t prime_1 = 0x9E3779B185EBCA87u, prime_2 = 0xC2B2AE3D27D4EB4Fu, prime_3 = 0x165667B19E3779F9u,
                   prime_4 = 0x85EBCA77C2B2AE63u, prime_5 = 0x27D4EB2F165667C5u;

template <typename Word>
uint64_t word_at(const std::byte* at) {
  Word word;
  std::memcpy(&word, at, sizeof word);
  return word;
}

uint64_t xxh_round(uint64_t lane, uint64_t word) { return std::rotl(lane + word * prime_2, 31) * prime_1; }

}  // namespace

std::string fnv1a_128(std::string_view bytes) {
  using Word = unsigned __int128;
  constexpr Word prime = (static_cast<Word>(0x0000000001000000ull) << 64) | 0x000000000000013Bull;
  Word hash = (static_cast<Word>(0x6c62272e07bb0142ull) << 64) | 0x62b821756295c58dull;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * prime;
  return fmt::format("{:016x}{:016x}", static_cast<uint64_t>(hash >> 64), static_cast<uint64_t>(hash));
}

uint64_t mix64(std::string_view bytes) {
  uint64_t hash = bytes.size();
  for (size_t i = 0; i < bytes.size(); i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash += word + 0x9e3779b97f4a7c15ull;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
    hash ^= hash >> 31;
  }
  return hash;
}

std::optional<FileHash> hash_of_file(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe would wait for a writer.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return std::nullopt;
  struct stat status {};
  std::optional<FileHash> out;
  if (::fstat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
    out = FileHash{};
  } else if (status.st_size == 0) {
    out = FileHash{0, mix64({})};
  } else {
    const auto bytes = static_cast<size_t>(status.st_size);
    void* const content = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0);
    if (content != MAP_FAILED) {
      out = FileHash{bytes, mix64({static_cast<const char*>(content), bytes})};
      ::munmap(content, bytes);
    }
  }
  ::close(file);
  return out;
}

void ContentHash::take(const std::byte* whole_stripe) {
  for (size_t lane = 0; lane < lanes_.size(); ++lane)
    lanes_[lane] = xxh_round(lanes_[lane], word_at<uint64_t>(whole_stripe + lane * sizeof(uint64_t)));
}

void ContentHash::add(std::span<const std::byte> bytes) {
  const size_t kept = bytes_ % stripe;
  bytes_ += bytes.size();
  if (kept > 0) {
    const auto more = bytes.first(std::min(stripe - kept, bytes.size()));
    std::ranges::copy(more, rest_.begin() + static_cast<std::ptrdiff_t>(kept));
    bytes = bytes.subspan(more.size());
    if (kept + more.size() < stripe) return;
    take(rest_.data());
  }
  for (; bytes.size() >= stripe; bytes = bytes.subspan(stripe)) take(bytes.data());
  std::ranges::copy(bytes, rest_.begin());
}

uint64_t ContentHash::value() const {
  uint64_t hash = prime_5;
  if (bytes_ >= stripe) {
    hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
    for (const uint64_t lane : lanes_) hash = (hash ^ xxh_round(0, lane)) * prime_1 + prime_4;
  }
  hash += bytes_;
  const std::byte *at = rest_.data(), *const end = at + bytes_ % stripe;
  for (; end - at >= 8; at += 8) hash = std::rotl(hash ^ xxh_round(0, word_at<uint64_t>(at)), 27) * prime_1 + prime_4;
  for (; end - at >= 4; at += 4) hash = std::rotl(hash ^ word_at<uint32_t>(at) * prime_1, 23) * prime_2 + prime_3;
  for (; at < end; ++at) hash = std::rotl(hash ^ word_at<uint8_t>(at) * prime_5, 11) * prime_1;
  hash = (hash ^ (hash >> 33)) * prime_2;
  hash = (hash ^ (hash >> 29)) * prime_3;
  return hash ^ (hash >> 32);
}

std::optional<uint64_t> content_hash(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return std::nullopt;
  struct stat status {};
  bool whole = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  ContentHash hash;
  std::vector<std::byte> block(size_t{1} << 20);
  // The file is read, not mapped: a read error of a mapped file would end the process.
  for (ssize_t read = 1; whole && read != 0;) {
    read = ::read(file, block.data(), block.size());
    if (read > 0) hash.add(std::span(block).first(static_cast<size_t>(read)));
    if (read < 0 && errno != EINTR) whole = false;
  }
  ::close(file);
  return whole ? std::optional(hash.value()) : std::nullopt;
}

}  // namespace wavetracer
