// Folders that parts of one run were written to, on whatever machines, made one: `wavetracer merge`.
// Needs no device and none of the run's input files. Parts are files from elsewhere: all that they say is checked.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "jobs/shards.hpp"
#include "jobs/units.hpp"

namespace wavetracer {

struct FoundParts {
  RunIdentity run;
  ShardMap shards;                                             // each unit once
  std::map<ShardMap::key_type, std::filesystem::path> places;  // the folder of its files
  std::filesystem::path record;                                // a run.json
  std::vector<Unit> missing;  // blocks, or stretches of frames: the first of them, at most 1000
  uint64_t missing_count = 0;
  std::vector<std::string> damaged;  // parts whose files are not as they were written, which count as missing
};

// Looks through DIR/shards of each. Throws InputError where there are no parts, or parts of different runs, and
// RuntimeError where a manifest is damaged.
FoundParts find_parts(const std::vector<std::filesystem::path>& directories);

// Writes the outputs into `directory` and returns their paths. Parts stay where they are. Throws RuntimeError.
std::vector<std::filesystem::path> merge_found(const FoundParts& found, const std::filesystem::path& directory,
                                               const std::string& command_line);

}  // namespace wavetracer
