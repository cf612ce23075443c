// DIR/shards, made where it is missing, with this process's file in it (output/process_files.hpp).
// Folders that were made here go again unless keep() is called.
#pragma once
#include <filesystem>
#include <utility>
#include "output/pending_file.hpp"
#include "output/process_files.hpp"

namespace wavetracer::app {

class FolderHold {
 public:
  FolderHold(const std::filesystem::path& directory, ProcessInfo process)
      : directory_(directory), shards_(directory / "shards"), presence_(shards_.path(), std::move(process)) {}
  const ProcessInfo& process() const { return presence_.process(); }
  void keep() {
    directory_.keep();
    shards_.keep();
  }

 private:
  PendingDirectory directory_, shards_;
  Presence presence_;  // its file goes before its folder
};

}  // namespace wavetracer::app
