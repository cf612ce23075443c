// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of shards: the run that they belong to, its cuts, and the names of the files in a folder.
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>
#include "base/hash.hpp"
#include "output/sample_run.hpp"

namespace wavetracer::test {

inline const RunIdentity identity = sample_identity(24);
inline const std::vector<std::pair<uint32_t, uint32_t>> cuts{{3, 7}, {10, 10}, {20, 5}};  // first, count

inline SampleRun with_waypoints() {
  SampleRun sample;
  sample.config.output.waypoints = 2;
  return sample;
}

// Rewrites the manifest so that all files match it: the damage cannot be found by hash.
inline void note_as_written(const std::filesystem::path& manifest) {
  std::string text;
  for (Shard shard : read_manifest(manifest)) {
    for (ShardFile& file : shard.files) {
      const std::filesystem::path place = manifest.parent_path() / file.name;
      file.bytes = std::filesystem::file_size(place);
      file.hash = content_hash(place).value();
    }
    text += encode_manifest_line(shard);
  }
  std::ofstream(manifest, std::ios::binary) << text;
}

// Returns the names in order.
inline std::vector<std::string> names(const std::filesystem::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) out.push_back(entry.path().filename());
  std::ranges::sort(out);
  return out;
}

}  // namespace wavetracer::test
