// SPDX-License-Identifier: Apache-2.0
// The file format of cached programs: magic, version, key text, source length and hash, payload length, checksum,
// payload. The file name is one hash of the key, and the header holds the key itself, so that a collision of names is
// detected.
#include "gpu/cache.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <fstream>
#include <functional>
#include <thread>
#include "base/environment.hpp"
#include "base/hash.hpp"
#include "base/output_place.hpp"

namespace wavetracer::gpu {

namespace {

constexpr std::string_view magic = "WTPROG\r\n";  // a transfer in text mode would change the line end
constexpr uint64_t format_version = 1;

void append_number(std::string& out, uint64_t value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_text(std::string& out, std::string_view text) {
  append_number(out, text.size());
  out.append(text);
}

// Returns everything before the payload's length: it is the same, byte for byte, for equal keys.
std::string header(const ProgramKey& key) {
  std::string out(magic);
  append_number(out, format_version);
  append_text(out, key.text());
  append_number(out, key.source.size());
  append_number(out, mix64(key.source));
  return out;
}

}  // namespace

std::string ProgramKey::text() const {
  std::string out;
  for (const std::string* field : {&options, &platform, &platform_version, &device, &driver}) append_text(out, *field);
  return out;
}

ProgramCache ProgramCache::from_environment() {
  std::filesystem::path root = environment("XDG_CACHE_HOME");
  if (const std::string home = environment("HOME"); root.empty() && !home.empty())
    root = std::filesystem::path(home) / ".cache";
  if (environment("WAVETRACER_NO_CACHE") == "1" || root.empty()) return ProgramCache({});
  return ProgramCache(root / "wavetracer" / "programs");
}

bool ProgramCache::waits_for_first() const {
  std::error_code error;
  return !directory_.empty() &&
         (!std::filesystem::exists(directory_, error) || std::filesystem::is_empty(directory_, error));
}

std::filesystem::path ProgramCache::path(const ProgramKey& key) const {
  return directory_ / fnv1a_128(key.text() + key.source);
}

std::optional<std::string> ProgramCache::load(const ProgramKey& key) const {
  if (directory_.empty()) return std::nullopt;
  std::error_code error;
  const auto size = std::filesystem::file_size(path(key), error);
  if (error) return std::nullopt;
  std::string file(size, '\0');
  if (!std::ifstream(path(key), std::ios::binary).read(file.data(), static_cast<std::streamsize>(size)))
    return std::nullopt;
  std::string_view rest = file;
  const std::string expected = header(key);
  if (!rest.starts_with(expected)) return std::nullopt;
  rest.remove_prefix(expected.size());
  std::string lengths;
  if (rest.size() < 2 * sizeof(uint64_t)) return std::nullopt;
  const std::string_view payload = rest.substr(2 * sizeof(uint64_t));
  append_number(lengths, payload.size());
  append_number(lengths, mix64(payload));
  if (!rest.starts_with(lengths)) return std::nullopt;
  return std::string(payload);
}

std::string ProgramCache::store(const ProgramKey& key, std::string_view compiled) const {
  if (directory_.empty()) return "";
  std::error_code error;
  std::filesystem::create_directories(directory_, error);
  const std::filesystem::path target = path(key);
  std::filesystem::path temporary = target;
  // Two threads may keep the same program at the same time, each for a context of its own.
  temporary += fmt::format(".tmp.{}.{:x}", ::getpid(), std::hash<std::thread::id>()(std::this_thread::get_id()));
  std::string head = header(key);
  append_number(head, compiled.size());
  append_number(head, mix64(compiled));
  std::ofstream out(temporary, std::ios::binary);
  out.write(head.data(), static_cast<std::streamsize>(head.size()));
  out.write(compiled.data(), static_cast<std::streamsize>(compiled.size()));
  out.close();
  if (out) std::filesystem::rename(temporary, target, error);
  if (out && !error) return "";
  std::filesystem::remove(temporary, error);
  const std::string why = write_obstacle(directory_);
  return fmt::format(
      "compiled kernels cannot be kept in {}{}, so each start compiles them again: set XDG_CACHE_HOME to a folder "
      "that can be written to, or WAVETRACER_NO_CACHE=1",
      directory_.string(), why.empty() ? "" : " (" + why + ")");
}

}  // namespace wavetracer::gpu
