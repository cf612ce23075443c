// SPDX-License-Identifier: Apache-2.0
// A claim is a hard link to the process's own file: link() is atomic, on network file systems too, and a claim is never
// seen half written. A process without a file of its own is dead.
#include "jobs/claims.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <set>
#include <vector>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = ".claim.";

// Returns 0 if this is not the name of a claim.
uint32_t attempt_of(const std::string& name, size_t at) {
  uint32_t attempt = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + at + mark.size(), end, attempt);
  return error == std::errc() && stop == end ? attempt : 0;
}

// Returns the name of the process, or empty if the file is not one of a process.
std::string name_in(const fs::path& file) {
  const std::optional<ProcessInfo> process = read_process(file);
  return process ? process->name : "";
}

}  // namespace

void Claims::look() {
  std::error_code none;
  std::map<std::string, uint32_t> latest;
  for (const auto& entry : fs::directory_iterator(folder_, none)) {
    const std::string name = entry.path().filename().string();
    const size_t at = name.rfind(mark);
    if (at == std::string::npos) continue;
    uint32_t& attempt = latest[name.substr(0, at)];
    attempt = std::max(attempt, attempt_of(name, at));
  }
  std::set<std::string> living;
  for (const ProcessInfo& process : processes_in(folder_))
    if (process.job == me_.job && alive(process)) living.insert(process.name);
  claims_.clear();
  for (const auto& [task, attempt] : latest)
    claims_[task] = {attempt, living.contains(name_in(folder_ / fmt::format("{}{}{}", task, mark, attempt)))};
}

ClaimState Claims::state(const std::string& task) const {
  const auto found = claims_.find(task);
  if (found == claims_.end()) return ClaimState::free;
  if (found->second.living) return ClaimState::taken;
  return found->second.attempt >= most_attempts ? ClaimState::failed : ClaimState::free;
}

bool Claims::take(const std::string& task) {
  if (state(task) != ClaimState::free) return false;
  const auto known = claims_.find(task);
  const uint32_t attempt = known == claims_.end() ? 1 : known->second.attempt + 1;
  const fs::path claim = folder_ / fmt::format("{}{}{}", task, mark, attempt);
  if (::link(process_file(folder_, me_).c_str(), claim.c_str()) == 0) {
    claims_[task] = {attempt, true};
    return true;
  }
  if (errno != EEXIST)
    throw RuntimeError(
        fmt::format("cannot write {}: {}; check the permissions of its folder, "
                    "and that its file system has hard links, or choose another one with -o",
                    claim.string(), std::strerror(errno)));
  claims_[task] = {attempt, true};  // another process was faster; the next look() tells which
  return false;
}

void remove_claims(const fs::path& folder, const std::string& except) {
  std::error_code none;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (const std::string name = entry.path().filename().string();
        name.find(mark) != std::string::npos && (except.empty() || !name.starts_with(except)))
      found.push_back(entry.path());
  for (const fs::path& path : found) fs::remove(path, none);
}

}  // namespace wavetracer
