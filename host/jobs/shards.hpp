// SPDX-License-Identifier: Apache-2.0
// A run on disk, unit by unit: shards of frames (or blocks of transmitters) while it runs, and at the end the same
// outputs as those of a run that is written at once. DIR/shards holds UNIT.h5, .csv and with output.waypoints
// .waypoints.h5, each a paths.h5, links.csv or waypoints.h5 of its frames, run.json, and the manifests of the processes
// that wrote them.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/link_statistics.hpp"
#include "jobs/manifest.hpp"
#include "jobs/merge_ahead.hpp"
#include "jobs/merge_parts.hpp"
#include "jobs/shard_files.hpp"
#include "output/frame_files.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Keys are first frame and block.
using ShardMap = std::map<std::pair<uint32_t, uint32_t>, Shard>;

Totals totals_of(const ShardMap& shards);
// Returns their files, in the order of their units.
MergeParts parts_of(const ShardMap& shards, const std::function<std::filesystem::path(const Shard&)>& folder_of);

// The files of a unit, under temporary names until it is closed.
class OpenUnit {
 public:
  OpenUnit(const Run& run, const Unit& unit, const std::filesystem::path& directory,
           const std::filesystem::path& folder);
  // Throws RuntimeError.
  void add(const FrameResult& frame);
  const Totals& totals() const { return files_.totals(); }

 private:
  const Run& run_;
  Unit unit_;
  PendingDirectory directory_, folder_;
  FrameFiles files_;
  double seconds_ = 0;  // seconds of writing

  friend class Shards;
};

class Shards {
 public:
  // Touches no file yet. inputs: those of the run, for messages.
  // config: the text of the run's configuration (Config::text), so that a message can name the keys that differ.
  Shards(std::filesystem::path directory, RunIdentity run, std::vector<InputFile> inputs = {}, std::string config = {});

  // Takes over what an interrupted run has finished in this folder: its shards, or the complete run, see complete().
  // Returns the number of shards; 0 if there is none. A shard whose
  // files have changed since they were written is not finished, see damaged(). Throws ConfigError if the shards belong
  // to another run, InputError if an input file has changed since. No other process may be writing there.
  size_t resume();
  // Removes what any run left in the folder. No other process may be writing there.
  void clear();
  // Declares that other processes write there, too: their finished units are read, and this process lists its own in a
  // manifest of its own, manifest.NAME.jsonl. keep: units of an earlier process of this name count, except those whose
  // files have changed since they were written. Throws as resume() does if something there belongs to another run.
  void share(const std::string& name, bool keep);
  // Writes run.json, which the first unit writes otherwise.
  void write_record(const Run& run) const;
  // Notes that this process, which shares, has nothing to do: it writes an empty manifest, so that merge knows of it.
  void note_empty(const Run& run) const;
  // Reads again what other processes have finished.
  void look();

  // Tells whether the outputs in the folder hold the complete run, whose shards were removed. Throws as resume() does.
  bool find_complete();
  // After find_complete() or resume(): the outputs hold the complete run, so there is nothing to compute or to merge.
  bool complete() const { return complete_.has_value(); }
  bool finished(const Unit& unit) const { return complete() || shards_.contains(key(unit)); }
  // Returns the totals of the finished shards.
  Totals totals() const;
  // Returns the outputs of a complete run.
  std::vector<std::filesystem::path> outputs() const;
  size_t count() const { return shards_.size(); }
  // Names parts that were rejected because they have changed since they were written, in words that begin with the
  // file.
  const std::vector<std::string>& damaged() const { return damaged_; }
  const std::filesystem::path& folder() const { return folder_; }

  // Begins a unit in the folder, to be written frame by frame. The first unit of a run that neither resumes nor shares
  // replaces everything that an earlier run left in the folder, once it is closed.
  std::unique_ptr<OpenUnit> open(const Run& run, const Unit& unit) const;
  // Puts the files of a whole unit in place and adds them to the manifest. It counts as finished after finish(). While
  // another thread opens, fills and closes units, only finished() may be called here.
  Shard close(OpenUnit& unit);
  void finish(Shard shard);
  // Does all of this for frames in memory.
  void write(const Run& run, Frames frames, uint32_t block = 0, uint32_t blocks = 1);

  // Writes the outputs, as write_outputs() does, and returns their paths: of the finished shards and of `unfinished`,
  // the first frames of the interrupted one, if any. There must be a frame. At most one block of rows of finished
  // shards is in memory. If the run is complete and output.keep_shards is off, all rows are read back and compared with
  // those of the shards, and a record says so: remove_merged() must be called next. ahead: has looked at this folder,
  // and must not look again. links: gets the figures of links.csv.
  std::vector<std::filesystem::path> merge(const Run& run, std::unique_ptr<OpenUnit> unfinished,
                                           MergeAhead* ahead = nullptr, LinkStatistics* links = nullptr);
  // Removes the shards that merge() has proved to be in the outputs. No other process may need them any more.
  void remove_merged();

 private:
  static ShardMap::key_type key(const Unit& unit) { return {unit.first, unit.block}; }

  std::filesystem::path directory_, folder_, manifest_;
  RunIdentity run_;
  std::vector<InputFile> inputs_;
  std::string config_;
  bool fresh_ = true;  // nothing in the folder belongs to this run
  bool shared_ = false;
  bool recorded_ = false;  // run.json is that of this run
  ShardMap shards_;
  std::optional<Shard> complete_;  // the complete run, whose files are the outputs
  std::vector<Shard> own_;         // lines of manifest_, if the folder is shared
  std::vector<std::string> damaged_;
  double write_seconds_ = 0;
  bool proved_ = false;  // the outputs were proved to hold the shards

  void take(std::vector<Shard> shards);
  std::vector<Shard> undamaged(std::vector<Shard> lines);
  void save(const std::vector<Shard>& lines) const;
  void note(const Shard& shard);
};

}  // namespace wavetracer
