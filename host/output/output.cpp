// Encodes the files one after the other, then lets all of them appear together.
// Assumes room in memory for one more copy of the paths or waypoints.
#include "output/output.hpp"
#include <chrono>
#include <string>
#include "output/earlier_run.hpp"
#include "output/h5_outputs.hpp"
#include "output/links_csv.hpp"
#include "output/pending_file.hpp"
#include "output/summary_json.hpp"

namespace wavetracer {

std::vector<std::filesystem::path> write_outputs(const std::filesystem::path& directory, const Run& run,
                                                 Frames frames) {
  const auto start = std::chrono::steady_clock::now();
  PendingDirectory folder(directory);
  std::vector<PendingFile> files;
  for (const H5Output& output : h5_outputs(run.config))
    files.push_back(write_whole(output, run, frames, folder.path() / output.name));
  write_links_csv(run, frames, files.emplace_back(folder.path() / "links.csv"));
  files.back().sync();
  const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string summary = encode_summary_json(run, totals_of(frames), write_seconds, 0);
  files.emplace_back(folder.path() / "summary.json", std::as_bytes(std::span(summary)));
  remove_outputs(folder.path(), files);
  commit_together(files);
  folder.keep();
  remove_shards(folder.path());
  std::vector<std::filesystem::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

}  // namespace wavetracer
