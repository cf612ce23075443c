// The outputs of consecutive frames on their way, frame by frame: the HDF5 files of the run, then links.csv.
// Of the frames memory holds nothing but their totals.
#pragma once
#include <filesystem>
#include <vector>
#include "output/h5_outputs.hpp"
#include "output/links_csv.hpp"
#include "output/totals.hpp"

namespace wavetracer {

class FrameFiles {
 public:
  // paths: of h5_outputs() in their order, then of the table of links. The run must outlive this.
  FrameFiles(const Run& run, const std::vector<std::filesystem::path>& paths);

  // Throws RuntimeError where they cannot be written, or the frame contradicts itself or the run.
  void add(const FrameResult& frame);
  // The files in the same order, synced but not in place. compression: of HDF5 files, the level of deflate from 0 to 9.
  // Nothing can be added then.
  std::vector<PendingFile> finish(uint32_t compression);
  // Of the frames so far.
  const Totals& totals() const { return totals_; }

 private:
  const Run& run_;
  std::vector<FrameTables> tables_;  // one an output
  LinksCsv links_;
  Totals totals_;

  void append(const FrameResult& frame);  // to the tables
};

}  // namespace wavetracer
