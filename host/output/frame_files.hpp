// SPDX-License-Identifier: Apache-2.0
// Writes the outputs of consecutive frames, frame by frame: the HDF5 files of the run, then links.csv.
// Memory holds only the totals of the frames.
#pragma once
#include <filesystem>
#include <vector>
#include "output/h5_outputs.hpp"
#include "output/links_csv.hpp"
#include "output/totals.hpp"

namespace wavetracer {

class FrameFiles {
 public:
  // paths: of h5_outputs() in their order, then of the table of links. The run must outlive this object.
  FrameFiles(const Run& run, const std::vector<std::filesystem::path>& paths);

  // Throws RuntimeError if a file cannot be written, or the frame contradicts itself or the run.
  void add(const FrameResult& frame);
  // Returns the files in the same order, synced but not in place. compression: level of deflate for HDF5 files, 0 to 9.
  // No frame can be added afterwards.
  std::vector<PendingFile> finish(uint32_t compression);
  // Totals of the frames so far.
  const Totals& totals() const { return totals_; }

 private:
  const Run& run_;
  std::vector<FrameTables> tables_;  // one for each output
  LinksCsv links_;
  Totals totals_;

  void append(const FrameResult& frame);  // appends to the tables
};

}  // namespace wavetracer
