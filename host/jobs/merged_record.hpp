// DIR/shards/merged.json: that the outputs in DIR hold a whole run, whose shards were removed when that was proved. It
// stays with run.json, so that --resume knows what is there.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/manifest.hpp"

namespace wavetracer {

// Writes it for outputs that are in place in the folder. Throws RuntimeError.
void write_merged_record(const std::filesystem::path& directory, const RunIdentity& run, const Totals& totals,
                         std::span<const PendingFile> outputs);

// The run that is whole in this folder, its files those of the folder; nothing where there is no record, or where one
// of its files is not as it was written. damaged: gets what is wrong with them, in words. Throws RuntimeError where the
// record is not one.
std::optional<Shard> read_merged_record(const std::filesystem::path& directory, std::vector<std::string>& damaged);

}  // namespace wavetracer
