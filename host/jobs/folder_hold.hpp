// SPDX-License-Identifier: Apache-2.0
// Reserves DIR/shards for this process: makes it if missing, and puts this process's file into it
// (jobs/process_files.hpp). A folder made here is removed again if nothing was put into it.
#pragma once
#include <filesystem>
#include <optional>
#include <utility>
#include "base/pending_file.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/process_files.hpp"

namespace wavetracer {

class FolderHold {
 public:
  // Throws RuntimeError if another process has the folder, see Presence.
  FolderHold(const std::filesystem::path& directory, ProcessInfo process)
      : directory_(directory), shards_(directory / "shards") {
    presence_.emplace(shards_.path(), std::move(process));
  }
  ~FolderHold() {
    presence_.reset();
    remove_if_empty(shards_.path());  // it was left by an earlier drive
  }
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;
  const ProcessInfo& process() const { return presence_->process(); }

 private:
  PendingDirectory directory_, shards_;
  std::optional<Presence> presence_;
};

}  // namespace wavetracer
