// Order makes it safe to be killed anywhere: files of a shard first, then its line in the manifest. What the manifest
// does not list is rubbish; what it lists is whole.
#include "output/shards.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include "output/links_csv.hpp"
#include "output/merge_h5.hpp"
#include "output/paths_h5.hpp"
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

// Files of the folder for which `which` holds of their names.
template <typename Which>
void remove_files(const fs::path& folder, const Which& which) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (which(entry.path().filename().string())) found.push_back(entry.path());
  for (const fs::path& path : found)
    if (std::error_code error; !fs::remove(path, error) && error)
      throw RuntimeError(fmt::format("cannot remove {}, of an earlier run: {}; remove it or choose another folder "
                                     "with -o",
                                     path.string(), error.message()));
}

bool is_shard_file(const std::string& name) { return name.starts_with("frames_"); }

// What a killed run was writing: OUTPUT.PROCESS.tmp
bool is_temporary_output(const std::string& name) {
  if (!name.ends_with(".tmp")) return false;
  for (const char* output : {"paths.h5.", "links.csv.", "summary.json.", "frames_"})
    if (name.starts_with(output)) return true;
  return false;
}

// The files of these frames, synced but not in place. Small enough for memory.
std::vector<PendingFile> pending_files(const Run& run, Frames frames, const fs::path& folder) {
  const std::string stem = fmt::format("frames_{:06}_{:06}", frames.front().frame, frames.back().frame);
  std::vector<PendingFile> files;
  {
    hdf5::File h5;
    encode_paths_h5(run, frames, h5);
    files.emplace_back(folder / (stem + ".h5"), h5.image());
  }
  write_links_csv(run, frames, files.emplace_back(folder / (stem + ".csv")));
  files.back().sync();
  return files;
}

PendingFile merged_h5(const Run& run, const std::vector<fs::path>& parts, const fs::path& path) {
  PendingFile file(path);
  hdf5::File head;
  encode_head_h5(run, head);
  const auto image = head.image();
  file.write(image);
  constexpr uint64_t slack = uint64_t{1} << 20;  // for the tables of contents
  uint64_t size = image.size() + slack;
  for (const fs::path& part : parts) size += fs::file_size(part);
  file.reserve(size);
  {
    hdf5::File merged = hdf5::File::open_to_write(file.temporary());
    merge_frames_h5(parts, merged);
    merged.flush();
  }
  file.sync();
  return file;
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

void remove_shards(const fs::path& directory, std::span<const PendingFile> except) {
  const fs::path folder = directory / "shards";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  remove_files(folder, [](const std::string& name) { return name.starts_with(manifest_name); });
  sync_folder(folder);  // no manifest may list the files that go now
  remove_files(folder, [except](const std::string& name) {
    return is_shard_file(name) && std::none_of(except.begin(), except.end(), [&name](const PendingFile& file) {
             return file.temporary().filename() == name;
           });
  });
  fs::remove(folder, ignored);  // not if there is something else in it
}

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
  remove_files(folder_, [](const std::string& name) { return name.ends_with(".tmp"); });
  remove_files(directory_, is_temporary_output);
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
  for (size_t i = 0; i < files.size(); ++i)
    shard.files[i] = {files[i].path().filename().string(), fs::file_size(files[i].temporary())};
  if (fresh_) {
    remove_shards(directory_, files);
    remove_files(directory_, [](const std::string& name) {
      return name == "paths.h5" || name == "links.csv" || name == "summary.json" || is_temporary_output(name);
    });
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
  std::vector<fs::path> h5, csv;
  for (const Shard& shard : shards_) {
    h5.push_back(folder_ / shard.files[0].name);
    csv.push_back(folder_ / shard.files[1].name);
  }
  if (!unfinished.empty()) {
    h5.push_back(parts_on_the_way[0].temporary());
    csv.push_back(parts_on_the_way[1].temporary());
  }
  std::vector<PendingFile> files;
  files.push_back(merged_h5(run, h5, directory_ / "paths.h5"));
  join_links_csv(csv, files.emplace_back(directory_ / "links.csv"));
  files.back().sync();
  Totals totals = this->totals();
  add(totals, totals_of(unfinished));
  const std::string summary = encode_summary_json(run, totals, write_seconds_ + since(start), shards_.size());
  files.emplace_back(directory_ / "summary.json", bytes(summary));
  if (fresh_) remove_shards(directory_);
  commit_together(files);
  directory.keep();
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

}  // namespace wavetracer
