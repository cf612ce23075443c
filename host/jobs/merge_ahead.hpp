// What a merge can do before the last unit is finished: of the units that are finished without a gap from the first one
// on, the tables of their files are found and their rows compressed. All of it is in this process alone, so nothing is
// left of it where the process ends; whoever merges then begins anew.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>
#include "base/idle_threads.hpp"
#include "jobs/manifest.hpp"
#include "output/h5_outputs.hpp"
#include "output/merge_h5.hpp"
#include "output/packed_ahead.hpp"

namespace wavetracer {

// An output as far as it goes.
struct OutputAhead {
  OutputAhead(const H5Output& output, IdleThreads& threads, const std::filesystem::path& scratch, uint32_t compression)
      : parts(output.growing_groups), chunks(threads, scratch, compression) {}
  GrowingParts parts;
  PackedAhead chunks;
};

class MergeAhead {
 public:
  // directory: of the run; nothing is touched yet. units: of frames.
  MergeAhead(const Config& config, const Units& units, std::filesystem::path directory);

  // Takes units that have finished since the last call, this process's and others'. Speaks to HDF5. Throws nothing:
  // where something is wrong with a part or the disk, the merge will meet it.
  void look() noexcept;

  // Compressed chunks of all outputs that are made so far.
  size_t chunks() const;

  // To merge: what is known of an output (its number among h5_outputs()) that is made of these parts, or nothing. No
  // look() is allowed then.
  OutputAhead* of(size_t output, std::span<const std::filesystem::path> parts);

 private:
  std::vector<H5Output> outputs_;
  uint32_t compression_;
  Units units_;
  std::filesystem::path directory_;
  NewLines lines_;
  uint64_t next_ = 0;                                      // index of the first unit that was not taken
  std::map<uint32_t, std::vector<std::string>> finished_;  // by first frame: names of files of units that wait for it
  bool given_up_ = false;
  std::vector<std::unique_ptr<OutputAhead>> ahead_;  // one an output, from the first unit on
  std::unique_ptr<IdleThreads> threads_;             // last: they use the others

  void take(const std::vector<std::string>& files);
};

}  // namespace wavetracer
