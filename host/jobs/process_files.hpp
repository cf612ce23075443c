// SPDX-License-Identifier: Apache-2.0
// The processes that write into the folder of a run: each has a file process_NAME in DIR/shards, which says who it is
// and is touched regularly. Processes of one job (ranks) share a folder; those of different jobs must not. On its own
// host, a process is alive if its id and start time are those of a running one; on other hosts, if its file was touched
// in the last heartbeat_limit_s, by the clock of the file system.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>
#include "base/pending_file.hpp"

namespace wavetracer {

inline constexpr double heartbeat_s = 10, heartbeat_limit_s = 120;

struct ProcessInfo {
  std::string name;  // name of its file, without the prefix: unique among all processes that ever shared the folder
  std::string job;   // name that all ranks of a job have; the process's own name if it shares with none
  std::string host, machine;  // machine: processes with equal values have a common numbering of process ids
  uint32_t rank = 0;
  int64_t pid = 0;
  uint64_t start = 0;  // clock ticks since the machine started
  std::string since;   // the same for people: a date and time, UTC
  double age_s = 0;    // time since it touched its file
};

// Returns this process. job: empty if it shares the folder with no other process.
ProcessInfo this_process(const std::string& job, uint32_t rank);

// Decodes the content of a process's file; returns nothing if the text is invalid. It is safe for any text.
std::optional<ProcessInfo> decode_process(std::string_view text);
std::string encode_process(const ProcessInfo& process);
// Reads such a file; returns nothing if it cannot be read, either.
std::optional<ProcessInfo> read_process(const std::filesystem::path& file);
std::filesystem::path process_file(const std::filesystem::path& folder, const ProcessInfo& process);

bool alive(const ProcessInfo& process);

// Returns the processes that have a file in the folder, including dead ones.
std::vector<ProcessInfo> processes_in(const std::filesystem::path& folder);

// Throws RuntimeError if a living process in the folder cannot share it with `me`, since it is of another job or has
// the same rank: the message says who it is, since when, and what to do. Without `me`, any living process is an error.
void check_not_in_use(const std::filesystem::path& folder, const std::optional<ProcessInfo>& me = std::nullopt);

// Removes the files of dead processes.
void remove_dead_processes(const std::filesystem::path& folder);

// This process's file, which exists as long as this object; it is touched every heartbeat_s. It is the lock of the
// folder: of two processes that cannot share it, one is refused, even if they come at the same time.
class Presence {
 public:
  // Throws RuntimeError if the folder cannot be written to, or check_not_in_use() throws.
  Presence(std::filesystem::path folder, ProcessInfo process);
  ~Presence();
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;
  const ProcessInfo& process() const { return process_; }

 private:
  std::filesystem::path file_;
  ProcessInfo process_;
  std::jthread heart_;
};

// Reserves DIR/shards for this process: makes it if missing, and puts this process's file into it. A folder made here
// is removed again if nothing was put into it.
class FolderHold {
 public:
  // Throws RuntimeError if another process has the folder, see Presence.
  FolderHold(const std::filesystem::path& directory, ProcessInfo process);
  ~FolderHold();
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;
  const ProcessInfo& process() const { return presence_->process(); }

 private:
  PendingDirectory directory_, shards_;
  std::optional<Presence> presence_;
};

}  // namespace wavetracer
