// SPDX-License-Identifier: Apache-2.0
// Tasks that processes of one job share; one of them does each task. DIR/shards/TASK.claim.N names the process that
// took it; only one process can create a file of that name. If the claimant is dead, another process makes claim N + 1,
// until most_attempts processes have died over a task. Claims are never removed while the job runs.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include "jobs/process_files.hpp"

namespace wavetracer {

// taken: by a living process; failed: most_attempts processes died over it.
enum class ClaimState { free, taken, failed };

class Claims {
 public:
  static constexpr uint32_t most_attempts = 2;

  // me: this process, which must have its file in the folder. Files of other processes of its job are looked up there.
  Claims(std::filesystem::path folder, const ProcessInfo& me) : folder_(std::move(folder)), me_(me) {}

  // Reads the existing claims, and checks which of their processes live.
  void look();
  // Returns the state at the last look(), updated by own claims since.
  ClaimState state(const std::string& task) const;
  // Takes the task if no living process has it: returns true if this process alone has it now.
  bool take(const std::string& task);

 private:
  struct Claim {
    uint32_t attempt = 0;  // 0 if there is none
    bool living = false;
  };
  std::filesystem::path folder_;
  ProcessInfo me_;
  std::map<std::string, Claim> claims_;
};

// Removes the claims of all tasks except those whose names begin with `except`. No process may be looking for one.
void remove_claims(const std::filesystem::path& folder, const std::string& except = "");

}  // namespace wavetracer
