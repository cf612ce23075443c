// SPDX-License-Identifier: Apache-2.0
// The files on the disk that a manifest's lines list: their state when they were written, and damage since.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/manifest.hpp"

namespace wavetracer {

// Returns name, length and hash of a complete file, in its place or under its temporary name. Throws RuntimeError.
ShardFile written_as(const PendingFile& file);

// Returns what is wrong with a file, in words that begin with its name: it is missing, or has changed. Empty if it is
// unchanged. It reads the whole file.
std::string damage_of(const ShardFile& file, const std::filesystem::path& folder);
// Does the same for the files of each shard, on all cores.
std::vector<std::string> damages(const std::vector<Shard>& shards, const std::filesystem::path& folder);

// Tells whether all files of the shard are in the folder, with their full length. It does not read them.
bool is_whole(const Shard& shard, const std::filesystem::path& folder);

}  // namespace wavetracer
