// SPDX-License-Identifier: Apache-2.0
// Merges folders with parts of one run, written on any machines: `wavetracer merge`.
// It needs no device and none of the run's input files. Parts are files from elsewhere: everything in them is checked.
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
  std::map<ShardMap::key_type, std::filesystem::path> places;  // folder of each unit's files
  std::filesystem::path record;                                // path of a run.json
  std::vector<Unit> missing;  // missing blocks, or ranges of frames: the first of them, at most 1000
  uint64_t missing_count = 0;
  std::vector<std::string> damaged;  // parts whose files have changed since they were written; they count as missing
};

// Searches DIR/shards of each folder. Throws InputError if there are no parts, or parts of different runs, and
// RuntimeError if a manifest is damaged.
FoundParts find_parts(const std::vector<std::filesystem::path>& directories);

// Writes the outputs into `directory` and returns their paths. The parts are not changed. Throws RuntimeError.
// whose: own parts are read in this process, which a damaged one may crash.
std::vector<std::filesystem::path> merge_found(const FoundParts& found, const std::filesystem::path& directory,
                                               const std::string& command_line, Parts whose = Parts::foreign);

}  // namespace wavetracer
