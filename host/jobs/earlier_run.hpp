// What an earlier run left in the folder of the outputs, and its removal.
// Touches only names that this program gives; whatever else is there stays.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include "base/pending_file.hpp"

namespace wavetracer {

// All throw RuntimeError where something cannot be removed, and do nothing where there is no such folder.

// What an earlier run left there, in words for whoever is about to replace it: "paths.h5, links.csv and shards in DIR".
// Empty where there is nothing.
std::string earlier_results(const std::filesystem::path& directory);

// Throws RuntimeError where a name of an output is a pipe, a device or a socket: a run reads its outputs again.
void check_output_names(const std::filesystem::path& directory);

// Outputs of a run, and the page that `view` made of them, but for those that these files are about to replace; and the
// record that they are whole. Of a link the file behind it is removed, and the link stays.
void remove_outputs(const std::filesystem::path& directory, std::span<const PendingFile> replaced = {});

// The manifests, then the shards that they list, but for these files on their way; then their folder, if that is all.
void remove_shards(const std::filesystem::path& directory, std::span<const PendingFile> except = {});

// The same of a run whose outputs are whole, once its record says so (jobs/merged_record.hpp), which stays with
// run.json. No other process may need the shards.
void remove_merged_shards(const std::filesystem::path& directory);

// Where that record is.
std::filesystem::path merged_record(const std::filesystem::path& directory);

// Removes the folder if it is empty and no link.
void remove_if_empty(const std::filesystem::path& folder);

// Removes what killed processes were writing into this folder of shards. Those that live have their files in it
// (jobs/process_files.hpp), and nothing of theirs is touched.
void remove_dead_temporaries(const std::filesystem::path& shards);

// What killed runs were writing into this very folder. No file may be on its way there.
void remove_temporaries(const std::filesystem::path& folder);

}  // namespace wavetracer
