// SPDX-License-Identifier: Apache-2.0
// Does the part of a merge that is possible before the last unit is finished: for finished units without a gap from the
// first one on, it finds the tables of their files and compresses their rows. All of this is in the memory of this
// process, so nothing is left if it ends; another process that merges then starts from the beginning.
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

// An output as far as it is known.
struct OutputAhead {
  OutputAhead(const H5Output& output, IdleThreads& threads, const std::filesystem::path& scratch, uint32_t compression)
      : parts(output.growing_groups), chunks(threads, scratch, compression) {}
  GrowingParts parts;
  PackedAhead chunks;
};

// It follows the run until the merge asks for what it has, or until it fails: then look() does nothing any more.
class MergeAhead {
 public:
  // directory: folder of the run; no file is touched yet. units: of frames.
  MergeAhead(const Config& config, const Units& units, std::filesystem::path directory);

  // Takes units of all processes that have finished since the last call. It calls HDF5. It never throws: if something
  // is wrong with a part or the disk, the merge will find it.
  void look() noexcept;

  // Returns the number of compressed chunks of all outputs so far.
  size_t chunks() const;

  // For the merge: returns what is known about an output (its index in h5_outputs()) made of these parts, or null.
  OutputAhead* of(size_t output, std::span<const std::filesystem::path> parts);

 private:
  std::vector<H5Output> outputs_;
  uint32_t compression_;
  Units units_;
  std::filesystem::path directory_;
  NewLines lines_;
  uint64_t next_ = 0;  // index of the first unit that was not taken
  // By first frame: names of files of finished units that wait for an earlier unit.
  std::map<uint32_t, std::vector<std::string>> finished_;
  enum class State { following, failed, merging } state_ = State::following;
  std::vector<std::unique_ptr<OutputAhead>> ahead_;  // one per output, from the first unit on
  std::unique_ptr<IdleThreads> threads_;             // their destructor ends them before the other members go

  void take(const std::vector<std::string>& files);
};

}  // namespace wavetracer
