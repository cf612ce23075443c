// SPDX-License-Identifier: Apache-2.0
// Finds gaps among the frames that the run was asked for, or among its blocks.
// If two parts hold the same unit, they must agree, and the first that is found is taken.
#include "jobs/merge_folders.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <optional>
#include "jobs/earlier_run.hpp"
#include "jobs/merge_outputs.hpp"
#include "jobs/run_record.hpp"
#include "jobs/shard_files.hpp"
#include "output/h5_outputs.hpp"
#include "output/head_h5.hpp"
#include "output/inputs.hpp"
#include "output/merge_h5.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_kept = 1000;

std::vector<InputFile> inputs_in(const fs::path& folder) {
  std::error_code none;
  const fs::path record = run_record_in(folder);
  return fs::exists(record, none) ? read_run_record(record).summary.inputs : std::vector<InputFile>();
}

// Throws InputError that names what differs.
void check_one_run(const RunIdentity& a, const fs::path& folder_a, const RunIdentity& b, const fs::path& folder_b) {
  const auto differs = [&](const std::string& what, const auto& one, const auto& other) {
    if (one != other)
      throw InputError(fmt::format("{} and {} hold parts of different runs: {} {} and {}; merge each by itself",
                                   folder_a.string(), folder_b.string(), what, one, other));
  };
  differs("version", a.version, b.version);
  differs("different hashes of the configuration", a.config, b.config);
  differs("device kinds", a.device_kind, b.device_kind);
  differs("--frames", fmt::format("{}:{}", a.first, a.last), fmt::format("{}:{}", b.first, b.last));
  differs("--repeat", a.repeat, b.repeat);
  if (a.inputs == b.inputs) return;
  const std::string which = changed_input(inputs_in(folder_a), inputs_in(folder_b));
  throw InputError(
      fmt::format("{} and {} hold parts of different runs: {}; compute one of them again with the input files of "
                  "the other, or merge each by itself",
                  folder_a.string(), folder_b.string(),
                  which.empty() ? "one of their input files differs" : which + " in the first"));
}

void add_missing(FoundParts& found, const Unit& unit) {
  ++found.missing_count;
  if (found.missing.size() < most_kept) found.missing.push_back(unit);
}

void find_missing(FoundParts& found) {
  const uint32_t blocks = found.shards.begin()->second.unit.blocks;
  if (blocks > 1) {
    for (uint32_t block = 0; block < blocks; ++block)
      if (!found.shards.contains({found.run.first, block}))
        add_missing(found, {found.run.first, found.run.last, block, blocks});
    return;
  }
  uint64_t next = found.run.first;
  for (const auto& [key, shard] : found.shards) {
    if (shard.unit.first > next) add_missing(found, {static_cast<uint32_t>(next), shard.unit.first - 1, 0, 1});
    next = uint64_t{shard.unit.last} + 1;
  }
  if (next <= found.run.last) add_missing(found, {static_cast<uint32_t>(next), found.run.last, 0, 1});
}

// No two parts may hold the same frames, unless they are the same unit.
void check_cut(const FoundParts& found) {
  const Shard* before = nullptr;
  for (const auto& [key, shard] : found.shards) {
    const bool fits =
        !before || (before->unit.blocks == shard.unit.blocks && before->files.size() == shard.files.size() &&
                    (shard.unit.blocks > 1 || before->unit.last < shard.unit.first));
    if (!fits)
      throw InputError(fmt::format("{} and {} cannot be merged: {} and {}", found.places.begin()->second.string(),
                                   found.places.at(key).string(), unit_words(before->unit), unit_words(shard.unit)));
    before = &shard;
  }
}

// Two parts of one unit, computed twice, must be equal.
void check_agrees(const Shard& a, const Shard& b, const fs::path& folder) {
  const bool same = a.unit == b.unit && a.totals.counts.paths == b.totals.counts.paths &&
                    a.totals.links == b.totals.links && a.totals.vertices == b.totals.vertices &&
                    a.totals.kinds == b.totals.kinds;
  if (!same)
    throw InputError(
        fmt::format("{}: {} differs from the same part elsewhere ({} paths and {}); leave one of the folders out",
                    folder.string(), unit_words(b.unit), b.totals.counts.paths, a.totals.counts.paths));
}

// Throws InputError if the folder has no parts.
void check_has_parts(const fs::path& directory, const fs::path& folder, const std::vector<fs::path>& manifests) {
  if (!manifests.empty()) return;
  std::error_code none;
  if (fs::exists(merged_record(directory), none))
    throw InputError(
        fmt::format("{}: nothing is left to merge: the outputs there hold the whole run, "
                    "and its parts were removed when that was proved (output.keep_shards = true keeps them)",
                    directory.string()));
  throw InputError(fmt::format("{}: this folder contains no parts of a run, because {} contains no manifest",
                               directory.string(), folder.string()));
}

// Adds a part whose files are in this folder. damage: says what is wrong with them, or is empty.
void add_part(FoundParts& found, Shard shard, const std::string& damage, const fs::path& folder) {
  const ShardMap::key_type key{shard.unit.first, shard.unit.block};
  if (!damage.empty()) {
    found.damaged.push_back(fmt::format("{} in {}: {}", unit_words(shard.unit), folder.string(), damage));
  } else if (const auto there = found.shards.find(key); there != found.shards.end()) {
    check_agrees(there->second, shard, folder);
  } else {
    found.places[key] = folder;
    found.shards.emplace(key, std::move(shard));
  }
}

}  // namespace

FoundParts find_parts(const std::vector<fs::path>& directories) {
  FoundParts found;
  std::optional<fs::path> first_folder;  // the folder whose first part says which run this is
  for (const fs::path& directory : directories) {
    const fs::path folder = directory / "shards";
    const std::vector<fs::path> manifests = manifests_in(folder);
    check_has_parts(directory, folder, manifests);
    std::error_code none;
    if (found.record.empty() && fs::exists(run_record_in(folder), none)) found.record = run_record_in(folder);
    for (const fs::path& manifest : manifests) {
      std::vector<Shard> lines = read_manifest(manifest);
      const std::vector<std::string> damage = damages(lines, folder);
      for (size_t line = 0; line < lines.size(); ++line) {
        if (!first_folder) {
          found.run = lines[line].run;
          first_folder = folder;
        }
        check_one_run(found.run, *first_folder, lines[line].run, folder);
        add_part(found, std::move(lines[line]), damage[line], folder);
      }
    }
  }
  if (found.shards.empty())
    throw InputError(fmt::format("{}: this folder contains no finished part of a run{}", directories.front().string(),
                                 found.damaged.empty() ? "" : "; damaged: " + found.damaged.front()));
  check_cut(found);
  find_missing(found);
  return found;
}

std::vector<fs::path> merge_found(const FoundParts& found, const fs::path& directory, const std::string& command_line,
                                  Parts whose) {
  const auto start = std::chrono::steady_clock::now();
  if (found.record.empty())
    throw RuntimeError(found.places.begin()->second.string() + ": run.json is missing, which every run leaves there");
  RunRecord record = read_run_record(found.record);
  record.summary.frames_asked = uint64_t{found.run.last} - found.run.first + 1;
  if (!command_line.empty()) record.summary.command_line += "; " + command_line;
  const MergeParts parts = parts_of(found.shards, [&](const Shard& shard) {
    return found.places.at({shard.unit.first, shard.unit.block});
  });
  if (parts.files.size() != h5_outputs(record.config).size() + 1)
    throw RuntimeError(found.record.string() +
                       " does not belong to the parts beside it: keys that say which files are written differ, "
                       "such as output.waypoints or response.bandwidth_hz");
  PendingDirectory folder(directory);
  std::vector<PendingFile> files = merge_outputs(record.config, parts, whose, Proof::none, directory,
                                                 [&](const H5Output& output, const fs::path& first, hdf5::File& head) {
                                                   reading_part(first, [&] { copy_head(output, first, head); });
                                                 });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string summary = encode_summary_json(record.run(), totals_of(found.shards), seconds, found.shards.size());
  files.emplace_back(directory / "summary.json", std::as_bytes(std::span(summary)));
  remove_outputs(directory, files);
  commit_together(files);
  folder.keep();
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

}  // namespace wavetracer
