// SPDX-License-Identifier: Apache-2.0
// The order of writes makes it safe to be killed at any time: files of a shard come first, then its line in the
// manifest. A file that no manifest lists is garbage; one that is listed is complete. If two manifests list a unit,
// both parts are equal.
#include "jobs/unit_folder.hpp"
#include <fmt/format.h>
#include <chrono>
#include <span>
#include <stdexcept>
#include <utility>
#include "jobs/earlier_run.hpp"
#include "jobs/run_record.hpp"
#include "jobs/shard_files.hpp"
#include "output/h5_outputs.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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

}  // namespace

void FolderState::take_over() {
  if (holds_ != Holds::earlier) throw std::logic_error("shards: an earlier run can only be continued at the beginning");
  holds_ = Holds::continued;
}

void FolderState::share() {
  if (holds_ != Holds::earlier && holds_ != Holds::continued)
    throw std::logic_error("shards: a folder can only be shared before a unit is written");
  holds_ = Holds::joined;
}

void FolderState::unit_in_place() {
  const bool with_others = holds_ == Holds::joined || holds_ == Holds::shared;
  holds_ = with_others ? Holds::shared : Holds::own;
}

OpenUnit::OpenUnit(const Run& run, const Unit& unit, const fs::path& directory, const fs::path& folder)
    : run_(run), unit_(unit), directory_(directory), folder_(folder), files_(run, files_of(unit, run.config, folder)) {}

void OpenUnit::add(const FrameResult& frame) {
  const Clock::time_point start = Clock::now();
  files_.add(frame);
  seconds_ += since(start);
}

std::vector<PendingFile> OpenUnit::finish() { return files_.finish(shard_compression); }

UnitFolder::UnitFolder(const fs::path& directory, RunIdentity run)
    : directory_(directory),
      folder_(directory / "shards"),
      manifest_(folder_ / "manifest.jsonl"),
      run_(std::move(run)) {}

void UnitFolder::take_over(const std::vector<Shard>& shards) {
  state_.take_over();
  write_manifest(shards);  // removes an incomplete line, after which nothing could be appended
  for (const fs::path& file : manifests_in(folder_))
    if (file != manifest_) fs::remove(file);
  remove_temporaries(folder_);
  remove_temporaries(directory_);
}

fs::path UnitFolder::share(const std::string& name) {
  state_.share();
  manifest_ = folder_ / fmt::format("manifest.{}.jsonl", name);
  return manifest_;
}

void UnitFolder::write_manifest(const std::vector<Shard>& lines) const {
  std::string text;
  for (const Shard& shard : lines) text += encode_manifest_line(shard);
  PendingFile(manifest_, bytes(text)).commit();
}

void UnitFolder::write_record(const Run& run) const {
  const std::string record = encode_run_record(run);
  PendingFile(run_record_in(folder_), bytes(record)).commit();
}

Shard UnitFolder::close(OpenUnit& unit) {
  using Holds = FolderState::Holds;
  const Clock::time_point start = Clock::now();
  const Holds before = state_.holds();
  std::vector<PendingFile> files = unit.finish();
  Shard shard{run_, unit.unit_, unit.totals(), {}};
  for (const PendingFile& file : files) shard.files.push_back(written_as(file));
  const std::string record = encode_run_record(unit.run_);
  if (before != Holds::own && before != Holds::shared) files.emplace_back(run_record_in(folder_), bytes(record));
  if (before == Holds::earlier) {
    remove_shards(directory_, files);
    remove_temporaries(directory_);
  }
  if (before != Holds::continued && before != Holds::own) remove_outputs(directory_);
  commit_together(files);
  unit.directory_.keep();
  unit.folder_.keep();
  std::error_code none;
  if (fs::exists(manifest_, none))
    append_to_file(manifest_, bytes(encode_manifest_line(shard)));
  else
    write_manifest({shard});
  state_.unit_in_place();
  seconds_ += unit.seconds_ + since(start);
  return shard;
}

void UnitFolder::put_outputs(std::vector<PendingFile>& files) const {
  if (state_.holds() == FolderState::Holds::earlier) remove_shards(directory_);
  remove_outputs(directory_, files);
  commit_together(files);
}

}  // namespace wavetracer
