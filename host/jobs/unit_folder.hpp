// SPDX-License-Identifier: Apache-2.0
// DIR/shards as this process writes to it: the files of units, run.json, and the manifest of this process.
// Shards (jobs/shards.hpp) knows which units are finished, and is what other code uses.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/manifest.hpp"
#include "output/frame_files.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// The contents of the folder, as far as this process has to do with them. They change in these ways:
//
//   take_over():      earlier -> continued
//   share():          earlier or continued -> joined
//   unit_in_place():  earlier or continued -> own; joined -> shared; own and shared stay
//
// The first two throw std::logic_error in any other state.
class FolderState {
 public:
  enum class Holds {
    earlier,    // nothing of this run; the first unit replaces what another run left
    continued,  // shards of this run that an earlier process wrote, and none of this process
    own,        // shards of this process, and run.json as this process wrote it
    joined,     // shards of other processes, which write there at the same time, and none of this process
    shared      // shards of other processes and of this one, and run.json as this process wrote it
  };
  Holds holds() const { return holds_; }

  void take_over();
  void share();
  void unit_in_place();

 private:
  Holds holds_ = Holds::earlier;
};

// The files of a unit, under temporary names until they are put in place.
class OpenUnit {
 public:
  OpenUnit(const Run& run, const Unit& unit, const std::filesystem::path& directory,
           const std::filesystem::path& folder);
  // Throws RuntimeError.
  void add(const FrameResult& frame);
  const Totals& totals() const { return files_.totals(); }
  // Returns the files, synced but not in place. No frame can be added afterwards.
  std::vector<PendingFile> finish();

 private:
  const Run& run_;
  Unit unit_;
  PendingDirectory directory_, folder_;
  FrameFiles files_;
  double seconds_ = 0;  // seconds of writing

  friend class UnitFolder;
};

class UnitFolder {
 public:
  // directory: of the outputs. No file is touched yet.
  UnitFolder(const std::filesystem::path& directory, RunIdentity run);

  // Continues an earlier run whose unchanged shards these are: one manifest lists them, and nothing else is left of it.
  // No other process may write there.
  void take_over(const std::vector<Shard>& shards);
  // Other processes write there, too: from now on, this process lists its units in manifest.NAME.jsonl. Returns the
  // path of that manifest, which an earlier process of this name may have left.
  std::filesystem::path share(const std::string& name);
  // Replaces the manifest of this process by these lines. Throws RuntimeError.
  void write_manifest(const std::vector<Shard>& lines) const;
  // Writes run.json. Throws RuntimeError.
  void write_record(const Run& run) const;

  // Puts the files of a whole unit in place and adds them to the manifest. The first unit of this process also writes
  // run.json, and replaces what an earlier run left if the folder holds that. Throws RuntimeError.
  Shard close(OpenUnit& unit);
  // Puts the outputs in place of those that are there. Throws RuntimeError.
  void put_outputs(std::vector<PendingFile>& files) const;
  // Returns the seconds that this process spent on writing units.
  double seconds() const { return seconds_; }

 private:
  std::filesystem::path directory_, folder_, manifest_;
  RunIdentity run_;
  FolderState state_;
  double seconds_ = 0;
};

}  // namespace wavetracer
