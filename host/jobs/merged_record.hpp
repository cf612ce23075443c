// SPDX-License-Identifier: Apache-2.0
// DIR/shards/merged.json says that the outputs in DIR hold a complete run, whose shards were removed once that was
// proved. It stays with run.json, so that --resume knows that the run is complete.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/manifest.hpp"

namespace wavetracer {

// Writes the record for outputs that are in place in the folder. Throws RuntimeError.
void write_merged_record(const std::filesystem::path& directory, const RunIdentity& run, const Totals& totals,
                         std::span<const PendingFile> outputs);

// Returns the run that is complete in this folder, with its output files; nothing if there is no record, or if one of
// its files has changed. damaged: gets messages about changed files. Throws RuntimeError if the record is invalid.
std::optional<Shard> read_merged_record(const std::filesystem::path& directory, std::vector<std::string>& damaged);

}  // namespace wavetracer
