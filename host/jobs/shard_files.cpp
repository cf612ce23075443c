// SPDX-License-Identifier: Apache-2.0
// Files that were just written are read from the system's cache.
#include "jobs/shard_files.hpp"
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <optional>
#include "base/hash.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

}  // namespace

ShardFile written_as(const PendingFile& file) {
  const fs::path& place = file.temporary().empty() ? file.path() : file.temporary();
  const std::optional<uint64_t> hash = content_hash(place);
  if (!hash) throw RuntimeError(fmt::format("cannot read back {}: is the disk damaged?", place.string()));
  return {file.path().filename().string(), fs::file_size(place), *hash};
}

std::string damage_of(const ShardFile& file, const fs::path& folder) {
  std::error_code error;
  const uint64_t bytes = fs::file_size(folder / file.name, error);
  if (error) return fmt::format("{} cannot be read: {}", file.name, error.message());
  if (bytes != file.bytes) return fmt::format("{} has {} bytes instead of {}", file.name, bytes, file.bytes);
  const std::optional<uint64_t> hash = content_hash(folder / file.name);
  if (!hash) return fmt::format("{} cannot be read to its end", file.name);
  return *hash == file.hash ? "" : file.name + " is not as it was written: the hash of its content differs";
}

std::vector<std::string> damages(const std::vector<Shard>& shards, const fs::path& folder) {
  std::vector<std::string> out(shards.size());
  tbb::parallel_for(size_t{0}, shards.size(), [&](size_t i) {
    for (const ShardFile& file : shards[i].files)
      if (out[i].empty()) out[i] = damage_of(file, folder);
  });
  return out;
}

bool is_whole(const Shard& shard, const fs::path& folder) {
  return std::all_of(shard.files.begin(), shard.files.end(), [&](const ShardFile& file) {
    std::error_code error;
    return fs::file_size(folder / file.name, error) == file.bytes && !error;
  });
}

}  // namespace wavetracer
