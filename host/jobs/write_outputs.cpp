// SPDX-License-Identifier: Apache-2.0
// Writes the files frame by frame, then lets all of them appear together.
#include "jobs/write_outputs.hpp"
#include <chrono>
#include <functional>
#include <string>
#include "base/pending_file.hpp"
#include "jobs/earlier_run.hpp"
#include "output/frame_files.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

namespace {

// add: adds the frames.
std::vector<std::filesystem::path> write_added(const std::filesystem::path& directory, const Run& run,
                                               const std::function<void(FrameFiles&)>& add) {
  const auto start = std::chrono::steady_clock::now();
  PendingDirectory folder(directory);
  std::vector<std::filesystem::path> paths;
  for (const H5Output& output : h5_outputs(run.config)) paths.push_back(folder.path() / output.name);
  paths.push_back(folder.path() / "links.csv");
  FrameFiles on_the_way(run, paths);
  add(on_the_way);
  std::vector<PendingFile> files = on_the_way.finish(run.config.output.compression);
  const double write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string summary = encode_summary_json(run, on_the_way.totals(), write_seconds, 0);
  files.emplace_back(folder.path() / "summary.json", std::as_bytes(std::span(summary)));
  remove_outputs(folder.path(), files);
  commit_together(files);
  folder.keep();
  remove_shards(folder.path());
  std::vector<std::filesystem::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  return written;
}

}  // namespace

std::vector<std::filesystem::path> write_outputs(const std::filesystem::path& directory, const Run& run,
                                                 Frames frames) {
  return write_added(directory, run, [&](FrameFiles& files) {
    for (const FrameResult& frame : frames) files.add(frame);
  });
}

std::vector<std::filesystem::path> write_frame(const std::filesystem::path& directory, const Run& run,
                                               FrameResult frame) {
  return write_added(directory, run, [&](FrameFiles& files) {
    files.add(frame);
    frame = FrameResult();
  });
}

}  // namespace wavetracer
