// Who writes into the folder of a run: a file per process in DIR/shards, process_NAME, that says who it is and is
// touched while it lives. Processes of one job (ranks) share a folder; those of different jobs must not. On its own
// host a process is alive while its id and start time are those of a running one; elsewhere while its file was touched
// in the last heartbeat_limit_s, by the clock of the file system.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace wavetracer {

inline constexpr double heartbeat_s = 10, heartbeat_limit_s = 120;

struct ProcessInfo {
  std::string name;           // of its file, without the prefix: unique among all processes that ever shared the folder
  std::string job;            // what its ranks have in common; its name where it has none
  std::string host, machine;  // machine: where process ids mean the same
  uint32_t rank = 0;
  int64_t pid = 0;
  uint64_t start = 0;  // clock ticks since the machine started
  std::string since;   // the same for people: a date and time, UTC
  double age_s = 0;    // since it touched its file
};

// This process. job: empty for one that shares with nobody.
ProcessInfo this_process(const std::string& job, uint32_t rank);

// What stands in the file of a process; nothing where it is not what one writes. Safe for any text.
std::optional<ProcessInfo> decode_process(std::string_view text);
std::string encode_process(const ProcessInfo& process);
// Of a file; nothing where it cannot be read, either.
std::optional<ProcessInfo> read_process(const std::filesystem::path& file);
std::filesystem::path process_file(const std::filesystem::path& folder, const ProcessInfo& process);

bool alive(const ProcessInfo& process);

// The processes that have a file in the folder, dead ones too.
std::vector<ProcessInfo> processes_in(const std::filesystem::path& folder);

// Throws RuntimeError where a process lives in the folder with which `me` cannot share it, one of another job or of the
// same rank: who it is, since when, and what to do. Without `me`: any process.
void check_not_in_use(const std::filesystem::path& folder, const std::optional<ProcessInfo>& me = std::nullopt);

// The files of dead processes go.
void remove_dead_processes(const std::filesystem::path& folder);

// This process's file, from now to the end of this object; it is touched every heartbeat_s. It is the lock of the
// folder: of two processes that cannot share it one is refused, however close together they come.
class Presence {
 public:
  // Throws RuntimeError where the folder cannot be written to, or check_not_in_use() does.
  Presence(std::filesystem::path folder, ProcessInfo process);
  ~Presence();
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;
  const ProcessInfo& process() const { return process_; }

 private:
  std::filesystem::path file_;
  ProcessInfo process_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread heart_;
};

}  // namespace wavetracer
