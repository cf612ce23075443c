// A drive on disk: shards of whole files as it goes, and at the end the same outputs as those of a run of one frame.
// DIR/shards holds frames_FIRST_LAST.h5 and .csv, each a paths.h5 and links.csv of its frames, and the manifest.
#pragma once
#include <filesystem>
#include <vector>
#include "output/manifest.hpp"
#include "output/output.hpp"
#include "output/pending_file.hpp"

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

  // Writes paths.h5, links.csv and summary.json of the finished shards and of `unfinished`, the first frames of the one
  // that was interrupted, and returns their paths. At least one frame is needed. Memory holds a block of rows at most.
  std::vector<std::filesystem::path> merge(const Run& run, Frames unfinished);

 private:
  std::filesystem::path directory_, folder_;
  RunIdentity run_;
  bool fresh_ = true;          // nothing in the folder is of this run
  std::vector<Shard> shards_;  // sorted by frames
  double write_seconds_ = 0;

  void save_manifest() const;
};

// Removes the shards that an earlier drive left in a folder, but for these files on their way. Throws RuntimeError.
void remove_shards(const std::filesystem::path& directory, std::span<const PendingFile> except = {});

}  // namespace wavetracer
