// SPDX-License-Identifier: Apache-2.0
// The manifests of a run, DIR/shards/manifest*.jsonl: one line of JSON per finished shard, appended when its files are
// in place. Each process writes its own manifest. A line that a killed run left incomplete is skipped.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "jobs/identity.hpp"
#include "jobs/units.hpp"
#include "output/totals.hpp"

namespace wavetracer {

struct ShardFile {
  std::string name;              // in the folder of the manifest
  uint64_t bytes = 0, hash = 0;  // hash: content_hash() of the file
};

struct Shard {
  RunIdentity run;
  Unit unit;
  Totals totals;
  std::vector<ShardFile> files;  // those of h5_outputs() in their order, then .csv
};

std::string encode_manifest_line(const Shard& shard);

// The files that its lines name: those of shards beside it, or the outputs of a complete run (jobs/merged_record.hpp).
enum class ManifestOf { shards, outputs };

// text: any bytes, taken as a whole manifest. name: for messages. Throws RuntimeError if a line other than the last is
// invalid or damaged.
std::vector<Shard> decode_manifest(std::string_view text, const std::string& name,
                                   ManifestOf what = ManifestOf::shards);

// Returns an empty list if there is no manifest. Throws RuntimeError if it cannot be read, or decode_manifest() throws.
std::vector<Shard> read_manifest(const std::filesystem::path& file);

// Reads the lines that processes add to the manifests of a folder. Manifests only grow.
class NewLines {
 public:
  explicit NewLines(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // Returns whole lines since the last call. Throws as read_manifest() does.
  std::vector<Shard> read();

 private:
  std::filesystem::path folder_;
  std::map<std::filesystem::path, uint64_t> done_;  // number of bytes that were read, by file
};

// Returns the manifests of a folder, sorted.
std::vector<std::filesystem::path> manifests_in(const std::filesystem::path& folder);

}  // namespace wavetracer
