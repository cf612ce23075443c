// Order makes it safe to be killed anywhere: files of a shard first, then its line in the manifest. What the manifest
// does not list is rubbish; what it lists is whole.
#include "output/shards.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include "output/earlier_run.hpp"
#include "output/h5_outputs.hpp"
#include "output/links_csv.hpp"
#include "output/pending_file.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const char* const manifest_name = "manifest.jsonl";

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

// The files of these frames, synced but not in place. Small enough for memory.
std::vector<PendingFile> pending_files(const Run& run, Frames frames, const fs::path& folder) {
  const std::string stem = fmt::format("frames_{:06}_{:06}", frames.front().frame, frames.back().frame);
  std::vector<PendingFile> files;
  for (const H5Output& output : h5_outputs(run.config))
    files.push_back(write_whole(output, run, frames, folder / (stem + output.part_suffix)));
  write_links_csv(run, frames, files.emplace_back(folder / (stem + ".csv")));
  files.back().sync();
  return files;
}

void check_same_run(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder) {
  const auto differs = [&](const std::string& what, const auto& was, const auto& is) {
    if (was != is)
      throw ConfigError(fmt::format("--resume: the shards in {} were written with {} {}, this run has {}; run it as "
                                    "before, or without --resume to replace them, or choose another folder with -o",
                                    folder.string(), what, was, is));
  };
  differs("version", there.version, asked.version);
  differs("a configuration whose hash is", there.config, asked.config);
  differs("a device of kind", there.device_kind, asked.device_kind);
  differs("--frames", fmt::format("{}:{}", there.first, there.last), fmt::format("{}:{}", asked.first, asked.last));
  differs("--repeat", there.repeat, asked.repeat);
}

bool is_whole(const Shard& shard, const fs::path& folder) {
  return std::all_of(shard.files.begin(), shard.files.end(), [&](const ShardFile& file) {
    std::error_code error;
    return fs::file_size(folder / file.name, error) == file.bytes && !error;
  });
}

}  // namespace

Shards::Shards(fs::path directory, RunIdentity run)
    : directory_(std::move(directory)), folder_(directory_ / "shards"), run_(std::move(run)) {}

size_t Shards::resume() {
  shards_ = read_manifest(folder_ / manifest_name);
  if (shards_.empty()) return 0;
  for (const Shard& shard : shards_) check_same_run(shard.run, run_, folder_);
  fresh_ = false;
  std::erase_if(shards_, [this](const Shard& shard) { return !is_whole(shard, folder_); });
  std::sort(shards_.begin(), shards_.end(),
            [](const Shard& a, const Shard& b) { return a.totals.first < b.totals.first; });
  save_manifest();  // without a torn line, after which nothing can be appended
  remove_temporaries(folder_);
  remove_temporaries(directory_);
  return shards_.size();
}

bool Shards::finished(uint32_t first_frame) const {
  return std::any_of(shards_.begin(), shards_.end(),
                     [=](const Shard& shard) { return shard.totals.first == first_frame; });
}

Totals Shards::totals() const {
  Totals sum;
  for (const Shard& shard : shards_) add(sum, shard.totals);
  return sum;
}

void Shards::save_manifest() const {
  std::string text;
  for (const Shard& shard : shards_) text += encode_manifest_line(shard);
  PendingFile(folder_ / manifest_name, bytes(text)).commit();
}

void Shards::write(const Run& run, Frames frames) {
  const Clock::time_point start = Clock::now();
  PendingDirectory directory(directory_), folder(folder_);
  std::vector<PendingFile> files = pending_files(run, frames, folder_);
  Shard shard{run_, totals_of(frames), {}};
  for (const PendingFile& file : files)
    shard.files.push_back({file.path().filename().string(), fs::file_size(file.temporary())});
  if (fresh_) {
    remove_shards(directory_, files);
    remove_outputs(directory_);
    remove_temporaries(directory_);
  }
  commit_together(files);
  directory.keep();
  folder.keep();
  const auto place = std::upper_bound(shards_.begin(), shards_.end(), shard, [](const Shard& a, const Shard& b) {
    return a.totals.first < b.totals.first;
  });
  shards_.insert(place, shard);
  if (std::exchange(fresh_, false))
    save_manifest();
  else
    append_to_file(folder_ / manifest_name, bytes(encode_manifest_line(shard)));
  write_seconds_ += since(start);
}

std::vector<fs::path> Shards::merge(const Run& run, Frames unfinished) {
  const Clock::time_point start = Clock::now();
  PendingDirectory directory(directory_);
  std::vector<PendingFile> parts_on_the_way;
  if (!unfinished.empty()) parts_on_the_way = pending_files(run, unfinished, directory_);
  // Of file i of a shard, all there are.
  const auto parts = [&](size_t i) {
    std::vector<fs::path> out;
    for (const Shard& shard : shards_) out.push_back(folder_ / shard.files.at(i).name);
    if (!unfinished.empty()) out.push_back(parts_on_the_way.at(i).temporary());
    return out;
  };
  std::vector<PendingFile> files;
  const std::span<const H5Output> outputs = h5_outputs(run.config);
  for (size_t i = 0; i < outputs.size(); ++i)
    files.push_back(merge_parts(outputs[i], run, parts(i), directory_ / outputs[i].name));
  join_links_csv(parts(outputs.size()), files.emplace_back(directory_ / "links.csv"));
  files.back().sync();
  Totals totals = this->totals();
  add(totals, totals_of(unfinished));
  const std::string summary = encode_summary_json(run, totals, write_seconds_ + since(start), shards_.size());
  files.emplace_back(directory_ / "summary.json", bytes(summary));
  if (fresh_) remove_shards(directory_);
  remove_outputs(directory_, files);
  commit_together(files);
  directory.keep();
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

}  // namespace wavetracer
