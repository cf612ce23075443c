// Tasks that processes of one job share, each done by one of them: DIR/shards/TASK.claim.N names the process that took
// it. One process alone can make a file of that name. A claim of a dead process is followed by claim N + 1 of another,
// until most_attempts have died over a task; claims are never removed while the job runs.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include "jobs/process_files.hpp"

namespace wavetracer {

enum class ClaimState { free, taken, failed };  // taken: by a living process; failed: most_attempts died over it

class Claims {
 public:
  static constexpr uint32_t most_attempts = 2;

  // me: has its file in the folder. Other processes of its job are looked up there.
  Claims(std::filesystem::path folder, const ProcessInfo& me) : folder_(std::move(folder)), me_(me) {}

  // Reads the claims that are there and which of their processes live.
  void look();
  // As of the last look, and of own claims since.
  ClaimState state(const std::string& task) const;
  // Takes the task if no living process has it: true where this process alone has it now.
  bool take(const std::string& task);

 private:
  struct Claim {
    uint32_t attempt = 0;  // 0: none
    bool living = false;
  };
  std::filesystem::path folder_;
  ProcessInfo me_;
  std::map<std::string, Claim> claims_;
};

// Of all tasks but those that begin so. No process may be looking for one.
void remove_claims(const std::filesystem::path& folder, const std::string& except = "");

}  // namespace wavetracer
