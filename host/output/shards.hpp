// A drive on disk: shards of whole files as it goes, and at the end the same outputs as those of a run of one frame.
// DIR/shards holds frames_FIRST_LAST.h5, .csv and with output.waypoints .waypoints.h5, each a paths.h5, links.csv or
// waypoints.h5 of its frames, and the manifest.
#pragma once
#include <filesystem>
#include <vector>
#include "output/manifest.hpp"
#include "output/output.hpp"

namespace wavetracer {

class Shards {
 public:
  // Nothing is touched yet.
  Shards(std::filesystem::path directory, RunIdentity run);

  // Takes over the finished shards of the run that was interrupted in this folder; 0 where there is none. A shard whose
  // files are gone or cut short is not finished. Throws ConfigError where they are of another run.
  size_t resume();
  bool finished(uint32_t first_frame) const;
  // Of the finished shards.
  Totals totals() const;
  size_t count() const { return shards_.size(); }

  // Writes a shard and notes it in the manifest. The first one of a run that does not resume takes the place of all
  // that an earlier run left in the folder.
  void write(const Run& run, Frames frames);

  // Writes the outputs, and returns their paths, as write_outputs() does: of the finished shards and of `unfinished`,
  // the first frames of the one that was interrupted. At least one frame is needed. Of finished shards, memory holds a
  // block of rows at most.
  std::vector<std::filesystem::path> merge(const Run& run, Frames unfinished);

 private:
  std::filesystem::path directory_, folder_;
  RunIdentity run_;
  bool fresh_ = true;          // nothing in the folder is of this run
  std::vector<Shard> shards_;  // sorted by frames
  double write_seconds_ = 0;

  void save_manifest() const;
};

}  // namespace wavetracer
