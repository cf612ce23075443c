// SPDX-License-Identifier: Apache-2.0
// Files are recognised by their names, and temporary ones by OUTPUT.PROCESS.tmp, as PendingFile names them.
// Nobody may add files meanwhile.
#include "jobs/earlier_run.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for_each.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>
#include "base/output_place.hpp"
#include "jobs/manifest.hpp"
#include "jobs/process_files.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> output_names{
    "paths.h5",    "waypoints.h5", "cache_entries.h5", "responses.h5", "beams.h5",
    "carriers.h5", "radar.h5",     "links.csv",        "summary.json", "view.html"};
constexpr std::string_view manifest_prefix = "manifest.", shard_prefix = "frames_", record_file = "run.json",
                           merged_name = "merged.json", job_file = "job.json";

// Returns files of the folder whose names satisfy `which`.
template <typename Which>
void remove_files(const fs::path& folder, const Which& which) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (which(entry.path().filename().string())) found.push_back(entry.path());
  tbb::parallel_for_each(found, [](const fs::path& path) {
    // On several cores: freeing the space of large files takes a while.
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    // It is a device or a pipe.
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
    if (!fs::remove(behind_links(path), error) && error)
      throw RuntimeError(
          fmt::format("cannot remove {}, of an earlier run: {}; remove it or choose another folder with -o",
                      path.string(), error.message()));
  });
}

bool is_output(const std::string& name) { return std::ranges::find(output_names, name) != output_names.end(); }

bool is_temporary(const std::string& name) {
  if (!name.ends_with(".tmp")) return false;
  return name.starts_with(manifest_prefix) || name.starts_with(shard_prefix) || name.starts_with(record_file) ||
         name.starts_with(merged_name) || name.starts_with(job_file) ||
         std::ranges::any_of(output_names, [&](std::string_view output) { return name.starts_with(output); });
}

}  // namespace

std::string earlier_results(const fs::path& directory) {
  std::error_code none;
  std::vector<std::string> names;
  for (const std::string_view name : output_names)
    if (fs::exists(directory / name, none)) names.emplace_back(name);
  if (fs::is_directory(directory / "shards", none) && !manifests_in(directory / "shards").empty())
    names.emplace_back("the shards");
  if (names.empty()) return "";
  return fmt::format("{} of an earlier run in {}", fmt::join(names, ", "), directory.string());
}

void check_output_names(const fs::path& directory) {
  for (const std::string_view name : output_names) {
    std::error_code none;
    const fs::file_status status = fs::status(directory / name, none);
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
      throw RuntimeError(
          fmt::format("cannot write {}: it is a device, a pipe or a socket, and results must be plain files; "
                      "choose another folder with -o",
                      (directory / name).string()));
  }
}

void remove_if_empty(const fs::path& folder) { ::rmdir(folder.c_str()); }

fs::path merged_record(const fs::path& directory) { return directory / "shards" / merged_name; }

void remove_outputs(const fs::path& directory, std::span<const PendingFile> replaced) {
  remove_files(directory / "shards", [](const std::string& name) { return name == merged_name; });
  remove_files(directory, [replaced](const std::string& name) {
    return is_output(name) &&
           std::ranges::none_of(replaced, [&](const PendingFile& file) { return file.path().filename() == name; });
  });
}

void remove_shards(const fs::path& directory, std::span<const PendingFile> except) {
  const fs::path folder = directory / "shards";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  remove_files(folder,
               [](const std::string& name) { return name.starts_with(manifest_prefix) || name == merged_name; });
  sync_folder(folder);  // before the files go, so that no manifest lists missing files
  remove_files(folder, [except](const std::string& name) {
    return (name.starts_with(shard_prefix) || name == record_file) &&
           std::ranges::none_of(except, [&](const PendingFile& file) { return file.temporary().filename() == name; });
  });
  remove_if_empty(folder);
}

void remove_merged_shards(const fs::path& directory) {
  const fs::path folder = directory / "shards";
  remove_files(folder, [](const std::string& name) { return name.starts_with(manifest_prefix); });
  sync_folder(folder);  // for the same reason
  remove_files(folder, [](const std::string& name) { return name.starts_with(shard_prefix); });
}

void remove_dead_temporaries(const fs::path& shards) {
  std::vector<std::string> living;  // suffixes of their names
  for (const ProcessInfo& process : processes_in(shards))
    if (alive(process)) living.push_back(fmt::format(".{}.tmp", process.pid));
  remove_files(shards, [&living](const std::string& name) {
    return is_temporary(name) &&
           std::ranges::none_of(living, [&](const std::string& ending) { return name.ends_with(ending); });
  });
}

void remove_temporaries(const fs::path& folder) { remove_files(folder, is_temporary); }

}  // namespace wavetracer
