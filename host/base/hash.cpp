// FNV-1a of 128 bits and a splitmix64 fold.
// Assumes a compiler with 128-bit integers (GCC, Clang) and a little-endian machine, as all OpenCL hosts here are.
#include "base/hash.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cstring>

namespace wavetracer {

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
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe would wait for its writer
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

}  // namespace wavetracer
