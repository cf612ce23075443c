// SPDX-License-Identifier: Apache-2.0
// Finished units are those that the manifests of the folder list, and whose files are there with their full length.
#include "jobs/shards.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include "jobs/earlier_run.hpp"
#include "jobs/merged_record.hpp"
#include "jobs/shard_files.hpp"
#include "output/hdf5_read.hpp"
#include "output/head_h5.hpp"
#include "output/inputs.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

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
      run_(std::move(run)),
      inputs_(std::move(inputs)),
      config_(std::move(config)),
      writing_(directory_, run_) {}

void Shards::take(std::vector<Shard> lines) {
  for (const Shard& shard : lines) check_same_run(shard.run, run_, folder_, config_, inputs_);
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

bool Shards::complete() const {
  mine();
  return std::holds_alternative<InOutputs>(frames_);
}

size_t Shards::count() const {
  mine();
  return shards_.size();
}

bool Shards::finished(const Unit& unit) const { return complete() || shards_.contains(key(unit)); }

bool Shards::find_complete() {
  mine();
  std::optional<Shard> whole = read_merged_record(directory_, damaged_);
  if (!whole) return false;
  check_same_run(whole->run, run_, folder_, config_, inputs_);
  frames_ = InOutputs{std::move(*whole)};
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
  std::vector<Shard> whole;
  for (const auto& [key, shard] : shards_) whole.push_back(shard);
  writing_.with([&](UnitFolder& folder) { folder.take_over(whole); });
  return shards_.size();
}

void Shards::clear() {
  mine();
  remove_shards(directory_);
  remove_outputs(directory_);
  remove_temporaries(directory_);
}

void Shards::share(const std::string& name, bool keep) {
  mine();
  const fs::path manifest = writing_.with([&](UnitFolder& folder) { return folder.share(name); });
  const std::vector<Shard> own = keep ? undamaged(read_manifest(manifest)) : std::vector<Shard>();
  std::error_code none;
  if (fs::exists(manifest, none)) writing_.with([&](UnitFolder& folder) { folder.write_manifest(own); });
  look();
}

void Shards::write_record(const Run& run) {
  writing_.with([&](UnitFolder& folder) { folder.write_record(run); });
}

void Shards::note_empty(const Run& run) {
  writing_.with([&](UnitFolder& folder) {
    folder.write_record(run);
    folder.write_manifest({});
  });
}

void Shards::look() {
  mine();
  take(all_lines(folder_));
}

Totals Shards::totals() const {
  mine();
  const auto* outputs = std::get_if<InOutputs>(&frames_);
  return outputs ? outputs->whole.totals : totals_of(shards_);
}

std::vector<fs::path> Shards::outputs() const {
  std::vector<fs::path> out;
  for (const ShardFile& file : std::get<InOutputs>(frames_).whole.files) out.push_back(directory_ / file.name);
  return out;
}

std::unique_ptr<OpenUnit> Shards::open(const Run& run, const Unit& unit) const {
  return std::make_unique<OpenUnit>(run, unit, directory_, folder_);
}

Shard Shards::close(OpenUnit& unit) {
  return writing_.with([&](UnitFolder& folder) { return folder.close(unit); });
}

void Shards::write(const Run& run, Frames frames, uint32_t block, uint32_t blocks) {
  const auto unit = open(run, {frames.front().frame, frames.back().frame, block, blocks});
  for (const FrameResult& frame : frames) unit->add(frame);
  finish(close(*unit));
}

void Shards::finish(Shard shard) {
  mine();
  const ShardMap::key_type unit = key(shard.unit);
  shards_.insert_or_assign(unit, std::move(shard));
}

std::vector<fs::path> Shards::merge(const Run& run, std::unique_ptr<OpenUnit> unfinished, MergeAhead* ahead,
                                    LinkStatistics* links) {
  mine();
  const auto start = std::chrono::steady_clock::now();
  PendingDirectory directory(directory_);
  MergeParts parts = parts_of(shards_, [this](const Shard&) { return folder_; });
  std::vector<PendingFile> parts_on_the_way;
  Totals totals = this->totals();
  if (unfinished && unfinished->totals().frames > 0) {
    parts_on_the_way = unfinished->finish();
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
  writing_.with([&](UnitFolder& folder) {
    const std::chrono::duration<double> merging = std::chrono::steady_clock::now() - start;
    const std::string summary = encode_summary_json(run, totals, folder.seconds() + merging.count(), shards_.size());
    files.emplace_back(directory_ / "summary.json", std::as_bytes(std::span(summary)));
    folder.put_outputs(files);
  });
  directory.keep();
  if (removes) {
    check_merged(directory_, run, totals);
    write_merged_record(directory_, run_, totals, files);
    frames_ = InBoth{};
  }
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

void Shards::remove_merged() {
  mine();
  if (std::holds_alternative<InBoth>(frames_)) remove_merged_shards(directory_);
}

}  // namespace wavetracer
