// The files of a manifest's lines on the disk: what they were when they were written, and what is wrong with them now.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/manifest.hpp"

namespace wavetracer {

// Name, length and hash of a file that is complete, in its place or under its temporary name. Throws RuntimeError.
ShardFile written_as(const PendingFile& file);

// Says what is wrong with a file, in words that begin with its name: it is gone, or not what was written. Empty where
// all is well. Reads it to its end.
std::string damage_of(const ShardFile& file, const std::filesystem::path& folder);
// The same of the files of each shard, on all cores.
std::vector<std::string> damages(const std::vector<Shard>& shards, const std::filesystem::path& folder);

// Are all files of the shard in the folder, in full length? Reads none.
bool is_whole(const Shard& shard, const std::filesystem::path& folder);

}  // namespace wavetracer
