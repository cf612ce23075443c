// SPDX-License-Identifier: Apache-2.0
// The order of writes makes it safe to be killed at any time: files of a shard come first, then its line in the
// manifest. A file that no manifest lists is garbage; one that is listed is complete. If two manifests list a unit,
// both parts are equal.
#include "jobs/shards.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include "jobs/earlier_run.hpp"
#include "jobs/merge_outputs.hpp"
#include "jobs/merged_record.hpp"
#include "jobs/run_record.hpp"
#include "jobs/same_run.hpp"
#include "output/hdf5_read.hpp"
#include "output/head_h5.hpp"
#include "output/inputs.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const char* const manifest_name = "manifest.jsonl";
const char* const record_name = "run.json";
constexpr uint32_t shard_compression = 0;  // they are read again soon, and merging copies their bytes

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

// Returns the files of a unit.
std::vector<fs::path> files_of(const Unit& unit, const Config& config, const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const H5Output& output : h5_outputs(config)) paths.push_back(folder / (unit_name(unit) + output.part_suffix));
  paths.push_back(folder / (unit_name(unit) + ".csv"));
  return paths;
}

// Checks that the merged file has all rows of the shards.
void check_merged(const fs::path& directory, const Run& run, const Totals& totals) {
  for (const H5Output& output : h5_outputs(run.config)) {
    if (std::string_view(output.name) != "paths.h5") continue;
    const hdf5::File file = hdf5::File::open_to_read(directory / output.name);
    const auto check = [&](const char* table, uint64_t wanted) {
      const hdf5::Column column(file, table);
      if (const uint64_t rows = column.shape().at(0); rows != wanted)
        throw RuntimeError(
            fmt::format("{}: {} has {} rows, the shards have {}; the shards are kept: run again with --resume",
                        (directory / output.name).string(), table, rows, wanted));
    };
    check("/frames/frame", totals.frames);
    check("/paths/delay_s", totals.counts.paths - totals.left_out.paths);
  }
}

std::vector<Shard> all_lines(const fs::path& folder) {
  std::vector<Shard> out;
  for (const fs::path& file : manifests_in(folder)) {
    std::vector<Shard> lines = read_manifest(file);
    std::ranges::move(lines, std::back_inserter(out));
  }
  return out;
}

}  // namespace

Totals totals_of(const ShardMap& shards) {
  Totals sum;
  for (const auto& [key, shard] : shards)
    if (shard.unit.blocks > 1)
      add_block(sum, shard.totals);
    else
      add(sum, shard.totals);
  return sum;
}

MergeParts parts_of(const ShardMap& shards, const std::function<fs::path(const Shard&)>& folder_of) {
  MergeParts parts;
  for (const auto& [key, shard] : shards) {
    parts.of_one_frame = shard.unit.blocks > 1;
    parts.files.resize(shard.files.size());
    for (size_t i = 0; i < shard.files.size(); ++i) parts.files[i].push_back(folder_of(shard) / shard.files[i].name);
  }
  return parts;
}

Shards::Shards(fs::path directory, RunIdentity run, std::vector<InputFile> inputs, std::string config)
    : directory_(std::move(directory)),
      folder_(directory_ / "shards"),
      manifest_(folder_ / manifest_name),
      run_(std::move(run)),
      inputs_(std::move(inputs)),
      config_(std::move(config)) {}

void Shards::take(std::vector<Shard> lines) {
  for (const Shard& shard : lines) {
    check_same_run(shard.run, run_, folder_, config_, inputs_);
  }
  for (Shard& shard : lines)
    if (!finished(shard.unit) && is_whole(shard, folder_)) shards_.emplace(key(shard.unit), std::move(shard));
}

std::vector<Shard> Shards::undamaged(std::vector<Shard> lines) {
  const std::vector<std::string> found = damages(lines, folder_);
  std::vector<Shard> out;
  for (size_t i = 0; i < lines.size(); ++i)
    if (found[i].empty())
      out.push_back(std::move(lines[i]));
    else
      damaged_.push_back((folder_ / found[i]).string());
  return out;
}

bool Shards::find_complete() {
  complete_ = read_merged_record(directory_, damaged_);
  if (!complete_) return false;
  check_same_run(complete_->run, run_, folder_, config_, inputs_);
  return true;
}

size_t Shards::resume() {
  if (find_complete()) {
    remove_merged_shards(directory_);  // a run that was killed during that may have left some
    remove_temporaries(folder_);
    remove_temporaries(directory_);
    return 0;
  }
  std::vector<Shard> lines = all_lines(folder_);
  if (lines.empty()) return 0;
  for (const Shard& shard : lines) check_same_run(shard.run, run_, folder_, config_, inputs_);
  take(undamaged(std::move(lines)));
  fresh_ = false;
  std::vector<Shard> whole;
  for (const auto& [key, shard] : shards_) whole.push_back(shard);
  save(whole);  // removes an incomplete line, after which nothing could be appended
  for (const fs::path& file : manifests_in(folder_))
    if (file != manifest_) fs::remove(file);
  remove_temporaries(folder_);
  remove_temporaries(directory_);
  return shards_.size();
}

void Shards::clear() {
  remove_shards(directory_);
  remove_outputs(directory_);
  remove_temporaries(directory_);
}

void Shards::share(const std::string& name, bool keep) {
  manifest_ = folder_ / fmt::format("manifest.{}.jsonl", name);
  shared_ = true;
  fresh_ = false;
  own_ = keep ? undamaged(read_manifest(manifest_)) : std::vector<Shard>();
  std::error_code none;
  if (fs::exists(manifest_, none)) save(own_);
  look();
}

void Shards::write_record(const Run& run) const {
  const std::string record = encode_run_record(run);
  PendingFile(folder_ / record_name, bytes(record)).commit();
}

void Shards::note_empty(const Run& run) const {
  write_record(run);
  save({});
}

void Shards::look() { take(all_lines(folder_)); }

Totals Shards::totals() const { return complete_ ? complete_->totals : totals_of(shards_); }

std::vector<fs::path> Shards::outputs() const {
  std::vector<fs::path> out;
  for (const ShardFile& file : complete_->files) out.push_back(directory_ / file.name);
  return out;
}

void Shards::save(const std::vector<Shard>& lines) const {
  std::string text;
  for (const Shard& shard : lines) text += encode_manifest_line(shard);
  PendingFile(manifest_, bytes(text)).commit();
}

void Shards::note(const Shard& shard) {
  std::error_code none;
  if (fresh_ || !fs::exists(manifest_, none))
    save({shard});
  else
    append_to_file(manifest_, bytes(encode_manifest_line(shard)));
  fresh_ = false;
}

OpenUnit::OpenUnit(const Run& run, const Unit& unit, const fs::path& directory, const fs::path& folder)
    : run_(run), unit_(unit), directory_(directory), folder_(folder), files_(run, files_of(unit, run.config, folder)) {}

void OpenUnit::add(const FrameResult& frame) {
  const Clock::time_point start = Clock::now();
  files_.add(frame);
  seconds_ += since(start);
}

std::unique_ptr<OpenUnit> Shards::open(const Run& run, const Unit& unit) const {
  return std::make_unique<OpenUnit>(run, unit, directory_, folder_);
}

Shard Shards::close(OpenUnit& unit) {
  const Clock::time_point start = Clock::now();
  std::vector<PendingFile> files = unit.files_.finish(shard_compression);
  Shard shard{run_, unit.unit_, unit.totals(), {}};
  for (const PendingFile& file : files) shard.files.push_back(written_as(file));
  const std::string record = encode_run_record(unit.run_);
  if (!recorded_) files.emplace_back(folder_ / record_name, bytes(record));
  if (fresh_) {
    remove_shards(directory_, files);
    remove_temporaries(directory_);
  }
  if (fresh_ || shared_) remove_outputs(directory_);
  commit_together(files);
  recorded_ = true;
  unit.directory_.keep();
  unit.folder_.keep();
  note(shard);
  write_seconds_ += unit.seconds_ + since(start);
  return shard;
}

void Shards::write(const Run& run, Frames frames, uint32_t block, uint32_t blocks) {
  const auto unit = open(run, {frames.front().frame, frames.back().frame, block, blocks});
  for (const FrameResult& frame : frames) unit->add(frame);
  finish(close(*unit));
}

void Shards::finish(Shard shard) {
  const ShardMap::key_type unit = key(shard.unit);
  shards_.insert_or_assign(unit, std::move(shard));
}

std::vector<fs::path> Shards::merge(const Run& run, std::unique_ptr<OpenUnit> unfinished, MergeAhead* ahead,
                                    LinkStatistics* links) {
  const Clock::time_point start = Clock::now();
  PendingDirectory directory(directory_);
  MergeParts parts = parts_of(shards_, [this](const Shard&) { return folder_; });
  std::vector<PendingFile> parts_on_the_way;
  Totals totals = this->totals();
  if (unfinished && unfinished->totals().frames > 0) {
    parts_on_the_way = unfinished->files_.finish(shard_compression);
    parts.files.resize(parts_on_the_way.size());
    for (size_t i = 0; i < parts_on_the_way.size(); ++i) parts.files[i].push_back(parts_on_the_way[i].temporary());
    add(totals, unfinished->totals());
  }
  const bool removes = !run.config.output.keep_shards && !unfinished && totals.frames == run.summary.frames_asked;
  std::vector<PendingFile> files = merge_outputs(
      run.config, parts, Parts::own, removes ? Proof::rows : Proof::none, directory_,
      [&run](const H5Output& output, const fs::path&, hdf5::File& head) { make_head(output, run, head); }, ahead,
      [&](const fs::path& links_csv) {
        if (links) *links = link_statistics(links_csv, run.config);
      });
  const std::string summary = encode_summary_json(run, totals, write_seconds_ + since(start), shards_.size());
  files.emplace_back(directory_ / "summary.json", bytes(summary));
  if (fresh_) remove_shards(directory_);
  remove_outputs(directory_, files);
  commit_together(files);
  directory.keep();
  if (removes) {
    check_merged(directory_, run, totals);
    write_merged_record(directory_, run_, totals, files);
    proved_ = true;
  }
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

void Shards::remove_merged() {
  if (proved_) remove_merged_shards(directory_);
}

}  // namespace wavetracer
