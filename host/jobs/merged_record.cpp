// SPDX-License-Identifier: Apache-2.0
// The record is one line of a manifest, with a unit that is the whole run and whose files are the outputs.
#include "jobs/merged_record.hpp"
#include <algorithm>
#include <string>
#include "base/file.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/shard_files.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t most_merged_bytes = uint64_t{1} << 30;  // it has the seconds of every frame

}  // namespace

void write_merged_record(const fs::path& directory, const RunIdentity& run, const Totals& totals,
                         std::span<const PendingFile> outputs) {
  Shard whole{run, {run.first, run.last, 0, 1}, totals, {}};
  for (const PendingFile& file : outputs) whole.files.push_back(written_as(file));
  const std::string line = encode_manifest_line(whole);
  PendingFile(merged_record(directory), std::as_bytes(std::span(line))).commit();
}

std::optional<Shard> read_merged_record(const fs::path& directory, std::vector<std::string>& damaged) {
  const fs::path record = merged_record(directory);
  const std::optional<std::string> text =
      read_text_if_there(record, most_merged_bytes, "check its permissions, or remove it and run again");
  if (!text) return std::nullopt;
  const std::vector<Shard> lines = decode_manifest(*text, record.string(), ManifestOf::outputs);
  if (lines.size() != 1) {
    damaged.push_back(record.string());
    return std::nullopt;
  }
  bool whole = true;
  for (const ShardFile& file : lines[0].files) {
    const std::string damage = damage_of(file, directory);
    if (damage.empty()) continue;
    damaged.push_back((directory / damage).string());
    whole = false;
  }
  return whole ? std::optional(lines[0]) : std::nullopt;
}

}  // namespace wavetracer
