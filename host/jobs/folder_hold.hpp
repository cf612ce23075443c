// DIR/shards, made where it is missing, with this process's file in it (jobs/process_files.hpp): who writes there.
// What was made here goes again where nothing was put into it.
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
  // Throws RuntimeError where another process has the folder, see Presence.
  FolderHold(const std::filesystem::path& directory, ProcessInfo process)
      : directory_(directory), shards_(directory / "shards") {
    presence_.emplace(shards_.path(), std::move(process));
  }
  ~FolderHold() {
    presence_.reset();
    remove_if_empty(shards_.path());  // of an earlier drive
  }
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;
  const ProcessInfo& process() const { return presence_->process(); }

 private:
  PendingDirectory directory_, shards_;
  std::optional<Presence> presence_;
};

}  // namespace wavetracer
