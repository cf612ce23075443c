// The manifests of a run, DIR/shards/manifest*.jsonl: one line of JSON a finished shard, appended when its files are in
// place. A process writes to one manifest, its own. A line that a killed run left half written is passed over.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "jobs/units.hpp"
#include "output/totals.hpp"

namespace wavetracer {

// What must agree between the runs that fill one folder.
struct RunIdentity {
  std::string version;
  std::string config;            // hash of its text, the folder of outputs and the places of input files left out
  std::string device_kind;       // "cpu" or "gpu"
  uint32_t first = 0, last = 0;  // frames asked for
  uint32_t repeat = 1;           // they share the seconds of a frame
  std::string inputs = {};       // hash of the contents of input files, which run.json lists
  bool operator==(const RunIdentity&) const = default;
};

struct ShardFile {
  std::string name;              // in the folder of the manifest
  uint64_t bytes = 0, hash = 0;  // hash: content_hash() of it
};

struct Shard {
  RunIdentity run;
  Unit unit;
  Totals totals;
  std::vector<ShardFile> files;  // those of h5_outputs() in their order, then .csv
};

std::string encode_manifest_line(const Shard& shard);

// Which files its lines name: those of shards beside it, or the outputs of a whole run (jobs/merged_record.hpp).
enum class ManifestOf { shards, outputs };

// text: of a whole manifest, any bytes. name: for messages. Throws RuntimeError where a line other than the last is
// none, or is damaged.
std::vector<Shard> decode_manifest(std::string_view text, const std::string& name,
                                   ManifestOf what = ManifestOf::shards);

// Empty where there is no manifest. Throws RuntimeError where it cannot be read, or decode_manifest() does.
std::vector<Shard> read_manifest(const std::filesystem::path& file);

// What manifests of a folder get while processes write them. Each is only appended to.
class NewLines {
 public:
  explicit NewLines(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // Whole lines since the last call. Throws as read_manifest() does.
  std::vector<Shard> read();

 private:
  std::filesystem::path folder_;
  std::map<std::filesystem::path, uint64_t> done_;  // bytes that were read
};

// The manifests of a folder, sorted.
std::vector<std::filesystem::path> manifests_in(const std::filesystem::path& folder);

}  // namespace wavetracer
