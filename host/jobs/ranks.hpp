// SPDX-License-Identifier: Apache-2.0
// Finds which of several processes of one run this is: from variables of Open MPI, PMI, Slurm, or of `run --devices`
// itself. No MPI library is needed, since processes only share a folder.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace wavetracer {

struct Ranks {
  uint32_t rank = 0, size = 1;
  uint32_t local_rank = 0, local_size = 1;  // rank and number among those on this host
  std::string
      job;  // a name that all ranks of this start have, and no other start has; empty where there is no launcher
  bool started = false;  // started by `run --devices`: only this program divides the cores of this host
};

// The division of a run's work among processes.
enum class Sharing {
  alone,   // this process does all of it
  shard,   // --shard K/N: a fixed part; other processes, started one by one, do the rest
  ranks,   // one of several processes that take units from a common folder
  starter  // --devices and --processes: this process starts ranks, and computes nothing itself
};

using Environment = std::function<const char*(const char*)>;

// variable: works as getenv(). Throws ConfigError for variables that contradict each other, or if the launcher gives no
// name of the start.
Ranks ranks_of(const Environment& variable);
Ranks ranks_of_this_process();

// Returns the number of tasks of a node from Slurm's list, "4(x2),3"; 0 if the list cannot be read.
uint32_t tasks_of_node(const std::string& list, uint32_t node);

// --shard K/N: K is from 0 to N - 1, N at most 2^20. Throws ConfigError.
struct ShardChoice {
  uint32_t index = 0, count = 1;
};
ShardChoice parse_shard(const std::string& text);

}  // namespace wavetracer
