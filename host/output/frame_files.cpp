// SPDX-License-Identifier: Apache-2.0
// Each kind of file has a function that appends a frame to it.
// HDF5 is not thread safe: only one thread may add and finish.
#include "output/frame_files.hpp"
#include "output/head_h5.hpp"
#include "output/path_limits.hpp"

namespace wavetracer {

FrameFiles::FrameFiles(const Run& run, const std::vector<std::filesystem::path>& paths)
    : run_(run), links_(run, paths.back()) {
  const size_t outputs = h5_outputs(run.config).size();
  tables_.reserve(outputs);
  for (size_t i = 0; i < outputs; ++i) tables_.emplace_back(paths.at(i));
}

void FrameFiles::add(const FrameResult& frame) {
  const std::vector<uint8_t> written = written_rows(frame.paths, run_.config.output);
  const LeftOutPaths gone = left_out(frame, written);
  if (gone.paths == 0 || frame.summed) {
    append(frame);
  } else {
    FrameResult limited;
    limited.frame = frame.frame;
    limited.world = frame.world;
    limited.paths = select_rows(frame.paths, written);
    limited.waypoints = frame.waypoints;
    limited.cache_entries = frame.cache_entries;
    limited.carriers = select_rows(frame.carriers, written);
    limited.responses = frame.responses;
    limited.beams = frame.beams;
    append(limited);
  }
  links_.add(frame, written);
  Totals totals = totals_of({&frame, 1});
  if (limits_paths(run_.config.output)) totals.left_out = gone;
  wavetracer::add(totals_, totals);
}

void FrameFiles::append(const FrameResult& frame) {
  const std::vector<H5Output> outputs = h5_outputs(run_.config);
  for (size_t i = 0; i < outputs.size(); ++i) outputs[i].append_frame(run_, frame, tables_[i]);
}

std::vector<PendingFile> FrameFiles::finish(uint32_t compression) {
  std::vector<PendingFile> files;
  const std::vector<H5Output> outputs = h5_outputs(run_.config);
  for (size_t i = 0; i < outputs.size(); ++i) {
    hdf5::File head;
    make_head(outputs[i], run_, head);
    files.push_back(tables_[i].finish(head, compression));
  }
  files.push_back(links_.finish());
  return files;
}

}  // namespace wavetracer
