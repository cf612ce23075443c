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
#include <variant>
#include <vector>
#include "base/guarded.hpp"
#include "base/one_thread.hpp"
#include "jobs/link_statistics.hpp"
#include "jobs/manifest.hpp"
#include "jobs/merge_outputs.hpp"
#include "jobs/unit_folder.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Keys are first frame and block.
using ShardMap = std::map<std::pair<uint32_t, uint32_t>, Shard>;

Totals totals_of(const ShardMap& shards);
// Returns their files, in the order of their units.
MergeParts parts_of(const ShardMap& shards, const std::function<std::filesystem::path(const Shard&)>& folder_of);

// Another thread may write units with open() and close() while frames are computed. All else is for the thread that
// made this object: on another one, functions that tell or change which units are finished throw std::logic_error.
class Shards {
 public:
  // Touches no file yet. inputs: those of the run, for messages.
  // config: the text of the run's configuration (Config::text), so that a message can name the keys that differ.
  Shards(std::filesystem::path directory, RunIdentity run, std::vector<InputFile> inputs = {}, std::string config = {});

  // Takes over what an interrupted run has finished in this folder: its shards, or the complete run, see complete().
  // Returns the number of shards; 0 if there is none. A shard whose files have changed since they were written is not
  // finished, see damaged(). Throws ConfigError if the shards belong to another run, InputError if an input file has
  // changed since. No other process may be writing there.
  size_t resume();
  // Removes what any run left in the folder. No other process may be writing there.
  void clear();
  // Declares that other processes write there, too: their finished units are read, and this process lists its own in a
  // manifest of its own, manifest.NAME.jsonl. keep: units of an earlier process of this name count, except those whose
  // files have changed since they were written. Throws as resume() does if something there belongs to another run.
  void share(const std::string& name, bool keep);
  // Writes run.json, which the first unit writes otherwise.
  void write_record(const Run& run);
  // Notes that this process, which shares, has nothing to do: it writes an empty manifest, so that merge knows of it.
  void note_empty(const Run& run);
  // Reads again what other processes have finished.
  void look();

  // Tells whether the outputs in the folder hold the complete run, whose shards were removed. Throws as resume() does.
  bool find_complete();
  // After find_complete() or resume(): the outputs hold the complete run, so there is nothing to compute or to merge.
  bool complete() const;
  bool finished(const Unit& unit) const;
  // Returns the totals of the finished shards.
  Totals totals() const;
  // Returns the outputs of a complete run; there must be one.
  std::vector<std::filesystem::path> outputs() const;
  size_t count() const;
  // Names parts that were rejected because they have changed since they were written, in words that begin with the
  // file.
  const std::vector<std::string>& damaged() const { return damaged_; }
  const std::filesystem::path& folder() const { return folder_; }

  // Begins a unit in the folder, to be written frame by frame. The first unit of a run that neither resumes nor shares
  // replaces everything that an earlier run left in the folder, once it is closed.
  std::unique_ptr<OpenUnit> open(const Run& run, const Unit& unit) const;
  // Puts the files of a whole unit in place and adds them to the manifest. It counts as finished after finish().
  Shard close(OpenUnit& unit);
  void finish(Shard shard);
  // Does all of this for frames in memory.
  void write(const Run& run, Frames frames, uint32_t block = 0, uint32_t blocks = 1);

  // Writes the outputs, as write_outputs() does, and returns their paths: of the finished shards and of `unfinished`,
  // the first frames of the interrupted one, if any. There must be a frame. At most one block of rows of finished
  // shards is in memory. If the run is complete and output.keep_shards is off, all rows are read back and compared with
  // those of the shards, and a record says so: remove_merged() must be called next. ahead: has looked at this folder.
  // links: gets the figures of links.csv.
  std::vector<std::filesystem::path> merge(const Run& run, std::unique_ptr<OpenUnit> unfinished,
                                           MergeAhead* ahead = nullptr, LinkStatistics* links = nullptr);
  // Removes the shards that merge() has proved to be in the outputs. No other process may need them any more.
  void remove_merged();

 private:
  static ShardMap::key_type key(const Unit& unit) { return {unit.first, unit.block}; }

  // The places of the run's frames. They change once or never:
  //   find_complete():             InShards -> InOutputs
  //   merge() with a proof:        InShards -> InBoth
  struct InShards {};  // in finished shards, as far as they are computed
  struct InOutputs {   // in the outputs, which an earlier process has proved; the shards may be gone
    Shard whole;       // the run as one shard, whose files are the outputs
  };
  struct InBoth {};  // in the outputs, which this process has proved, and in shards, which may go

  std::filesystem::path directory_, folder_;
  RunIdentity run_;
  std::vector<InputFile> inputs_;
  std::string config_;
  OneThread owner_;
  std::variant<InShards, InOutputs, InBoth> frames_;
  ShardMap shards_;
  std::vector<std::string> damaged_;
  Guarded<UnitFolder> writing_;

  void mine() const { owner_.check("shards"); }
  void take(std::vector<Shard> shards);
  std::vector<Shard> undamaged(std::vector<Shard> lines);
};

}  // namespace wavetracer
