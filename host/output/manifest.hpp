// The manifest of a drive, DIR/shards/manifest.jsonl: one line of JSON a finished shard, appended when its files are in
// place. A line that a killed run left half written is passed over.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "output/totals.hpp"

namespace wavetracer {

// What must agree between the runs that fill one folder.
struct RunIdentity {
  std::string version;
  std::string config;       // hash of its text, the folder of outputs left out
  std::string device_kind;  // "cpu" or "gpu"
  uint32_t first = 0, last = 0;  // frames asked for
  uint32_t repeat = 1;           // repeats begin cold, so their number changes what a frame reuses
  bool operator==(const RunIdentity&) const = default;
};

struct ShardFile {
  std::string name;  // in the folder of the manifest
  uint64_t bytes = 0;
};

struct Shard {
  RunIdentity run;
  Totals totals;
  std::vector<ShardFile> files;  // those of h5_outputs() in their order, then .csv
};

std::string encode_manifest_line(const Shard& shard);

// Empty where there is no manifest. Throws RuntimeError where it cannot be read or a line other than the last is none.
std::vector<Shard> read_manifest(const std::filesystem::path& file);

}  // namespace wavetracer
