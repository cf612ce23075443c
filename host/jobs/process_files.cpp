// SPDX-License-Identifier: Apache-2.0
// JSON files of a line, and /proc for the processes of this machine.
// Linux only: start times and namespaces of processes come from /proc.
#include "jobs/process_files.hpp"
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include "base/json_whole.hpp"
#include "jobs/earlier_run.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "process_";
constexpr size_t most_process_bytes = 4096;  // largest size of a process file

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

std::string first_line(const fs::path& file) {
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  return line;
}

// Containers on one machine may number their processes separately.
std::string machine_name() {
  std::error_code none;
  return first_line("/proc/sys/kernel/random/boot_id") + " " + fs::read_symlink("/proc/self/ns/pid", none).string();
}

// Returns field 22 of /proc/PID/stat; the second field, in parentheses, may contain blanks. Returns nothing if there is
// no such process, or it is a zombie.
std::optional<uint64_t> start_of(int64_t pid) {
  const std::string stat = first_line(fmt::format("/proc/{}/stat", pid));
  const size_t name_end = stat.rfind(") ");
  if (name_end == std::string::npos) return std::nullopt;
  const std::string rest = stat.substr(name_end + 2);
  if (rest.starts_with('Z') || rest.starts_with('X')) return std::nullopt;
  size_t at = 0;
  for (int field = 3; field < 22; ++field) {
    at = rest.find(' ', at);
    if (at == std::string::npos) return std::nullopt;
    ++at;
  }
  return std::strtoull(rest.c_str() + at, nullptr, 10);
}

double modified_s(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return 0;
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

// A shared file system has the clock of its server.
double now_in(const fs::path& folder) {
  std::string name = (folder / "clock_XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  ::close(file);
  const double now = modified_s(name);
  ::unlink(name.c_str());
  return now;
}

// Makes processes enter a folder one after the other, if its file system can lock folders.
class Turn {
 public:
  explicit Turn(const fs::path& folder) : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (folder_ >= 0 && ::flock(folder_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Turn() {
    if (folder_ >= 0) ::close(folder_);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int folder_;
};

}  // namespace

ProcessInfo this_process(const std::string& job, uint32_t rank) {
  ProcessInfo process{.name = "",
                      .job = job,
                      .host = host_name(),
                      .machine = machine_name(),
                      .rank = rank,
                      .pid = getpid(),
                      .start = start_of(getpid()).value_or(0),
                      .since = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)))};
  process.name = fmt::format("{}_{}_{:08x}", process.host, process.pid, std::random_device{}());
  if (job.empty()) process.job = process.name;
  return process;
}

std::string encode_process(const ProcessInfo& p) {
  const nlohmann::ordered_json json = {{"name", p.name}, {"job", p.job}, {"host", p.host},   {"machine", p.machine},
                                       {"rank", p.rank}, {"pid", p.pid}, {"start", p.start}, {"since", p.since}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<ProcessInfo> decode_process(std::string_view text) {
  if (text.size() > most_process_bytes) return std::nullopt;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  try {
    return ProcessInfo{.name = json.at("name"),
                       .job = json.at("job"),
                       .host = json.at("host"),
                       .machine = json.at("machine"),
                       .rank = whole_at<uint32_t>(json, "rank"),
                       .pid = whole_at<int64_t>(json, "pid"),
                       .start = whole_at<uint64_t>(json, "start"),
                       .since = json.value("since", "an unknown time")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::optional<ProcessInfo> read_process(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(most_process_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  return decode_process(text);
}

fs::path process_file(const fs::path& folder, const ProcessInfo& process) {
  return folder / (std::string(prefix) + process.name);
}

bool alive(const ProcessInfo& process) {
  if (process.machine == machine_name()) return start_of(process.pid) == process.start;
  return process.age_s < heartbeat_limit_s;
}

std::vector<ProcessInfo> processes_in(const fs::path& folder) {
  std::vector<ProcessInfo> out;
  std::error_code none;
  std::optional<double> now;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || name.ends_with(".tmp")) continue;
    std::optional<ProcessInfo> process = read_process(entry.path());
    if (!process || process->name != name.substr(prefix.size())) continue;
    if (!now) now = now_in(folder);
    process->age_s = *now - modified_s(entry.path());
    out.push_back(std::move(*process));
  }
  return out;
}

void check_not_in_use(const fs::path& folder, const std::optional<ProcessInfo>& me) {
  for (const ProcessInfo& process : processes_in(folder)) {
    if (me && (process.name == me->name || (process.job == me->job && process.rank != me->rank))) continue;
    if (!alive(process)) continue;
    throw RuntimeError(fmt::format(
        "{}: process {} on {} writes there since {}; wait until it is done, or choose another folder "
        "with -o (a process on another host that was killed counts as running until {:.0f} s after its last sign "
        "of life)",
        folder.string(), process.pid, process.host, process.since, heartbeat_limit_s));
  }
}

void remove_dead_processes(const fs::path& folder) {
  std::error_code none;
  for (const ProcessInfo& process : processes_in(folder))
    if (!alive(process)) fs::remove(process_file(folder, process), none);
}

Presence::Presence(fs::path folder, ProcessInfo process) : process_(std::move(process)) {
  file_ = process_file(folder, process_);
  const std::string text = encode_process(process_);
  PendingFile file(file_, std::as_bytes(std::span(text)));
  {
    const Turn turn(folder);
    file.commit();  // before the check of other files: without locks, two processes that come at once may both be
                    // refused
    try {
      check_not_in_use(folder, process_);
    } catch (...) {
      std::error_code none;
      fs::remove(file_, none);
      throw;
    }
    remove_dead_processes(folder);
  }
  heart_ = std::jthread([path = file_](const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    const auto beat = std::chrono::duration<double>(heartbeat_s);
    while (!stop.stop_requested()) {
      wake.wait_for(lock, stop, beat, [] { return false; });  // until the next beat, or until the end
      if (!stop.stop_requested()) ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // the time of the file system
    }
  });
}

Presence::~Presence() {
  heart_.request_stop();
  heart_.join();
  std::error_code none;
  fs::remove(file_, none);
}

FolderHold::FolderHold(const fs::path& directory, ProcessInfo process)
    : directory_(directory), shards_(directory / "shards") {
  presence_.emplace(shards_.path(), std::move(process));
}

FolderHold::~FolderHold() {
  presence_.reset();
  remove_if_empty(shards_.path());  // it was left by an earlier drive
}

}  // namespace wavetracer
