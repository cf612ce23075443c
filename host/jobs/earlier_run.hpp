// SPDX-License-Identifier: Apache-2.0
// Finds and removes what an earlier run left in the folder of the outputs.
// It touches only names that this program gives; all other files stay.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include "base/pending_file.hpp"

namespace wavetracer {

// All functions throw RuntimeError if a file cannot be removed, and do nothing if the folder does not exist.

// Describes what an earlier run left there, for a message before it is replaced: "paths.h5, links.csv and shards in
// DIR". Empty if there is nothing.
std::string earlier_results(const std::filesystem::path& directory);

// Throws RuntimeError if the name of an output is a pipe, a device or a socket: a run reads its outputs again.
void check_output_names(const std::filesystem::path& directory);

// Removes outputs of a run, and the page that `view` made of them, except those that `replaced_by` is about to replace;
// and the record that they are complete. For a link, the file behind it is removed, and the link stays.
void remove_outputs(const std::filesystem::path& directory, std::span<const PendingFile> replaced = {});

// Removes the manifests, then the shards that they list, except for these unfinished files; then their folder, if it is
// empty.
void remove_shards(const std::filesystem::path& directory, std::span<const PendingFile> except = {});

// Does the same for a run whose outputs are complete, once its record says so (jobs/merged_record.hpp); the record and
// run.json stay. No other process may need the shards.
void remove_merged_shards(const std::filesystem::path& directory);

// Returns the path of that record.
std::filesystem::path merged_record(const std::filesystem::path& directory);

// Removes the folder if it is empty and no link.
void remove_if_empty(const std::filesystem::path& folder);

// Removes temporary files that killed processes left in this folder of shards. Living processes have their files in it
// (jobs/process_files.hpp), and theirs are not touched.
void remove_dead_temporaries(const std::filesystem::path& shards);

// Removes temporary files that killed runs left in this folder itself. No file may be written there meanwhile.
void remove_temporaries(const std::filesystem::path& folder);

}  // namespace wavetracer
