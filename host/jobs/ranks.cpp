// SPDX-License-Identifier: Apache-2.0
// Reads variables of launchers, as their documentation describes them.
// A batch script that starts the program without srun has variables of Slurm, but no step: that is one process.
#include "jobs/ranks.hpp"
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t most_ranks = 1u << 20;
constexpr uint32_t last_slurm_step = 0xFFFFFFEFu;  // higher numbers are batch script, interactive and external steps

std::optional<uint32_t> count_in(std::string_view text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string text_of(const Environment& variable, const char* name) {
  const char* value = variable(name);
  return value ? value : "";
}

// Returns nothing if the variable is not set or is no number.
std::optional<uint32_t> number_of(const Environment& variable, const char* name) {
  return count_in(text_of(variable, name));
}

// Returns the first of these variables that is set.
std::string first_of(const Environment& variable, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const std::string value = text_of(variable, name); !value.empty()) return std::string(name) + "=" + value;
  return {};
}

struct Launcher {
  const char *rank, *size, *local_rank, *local_size;
};
constexpr Launcher ours{"WAVETRACER_RANK", "WAVETRACER_RANKS", "WAVETRACER_RANK", "WAVETRACER_RANKS"},
    open_mpi{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_RANK",
             "OMPI_COMM_WORLD_LOCAL_SIZE"},
    pmi{"PMI_RANK", "PMI_SIZE", "MPI_LOCALRANKID", "MPI_LOCALNRANKS"},
    slurm{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "SLURM_LOCALID", ""};

std::optional<Ranks> from(const Launcher& launcher, const Environment& variable) {
  if (text_of(variable, launcher.rank).empty() || text_of(variable, launcher.size).empty()) return std::nullopt;
  const auto rank = number_of(variable, launcher.rank), size = number_of(variable, launcher.size);
  if (!rank || !size || *size == 0 || *rank >= *size || *size > most_ranks)
    throw ConfigError(fmt::format(
        "{}={}, {}={}: these are not a rank and a number of ranks (up to {}); "
        "unset both variables to run one process",
        launcher.rank, text_of(variable, launcher.rank), launcher.size, text_of(variable, launcher.size), most_ranks));
  Ranks ranks;
  ranks.rank = *rank;
  ranks.size = *size;
  ranks.local_rank = number_of(variable, launcher.local_rank).value_or(0);
  ranks.local_size = number_of(variable, launcher.local_size).value_or(1);
  ranks.local_size = std::max(ranks.local_size, ranks.local_rank + 1);
  return ranks;
}

// PMI itself has no name for a launch: on one host, all ranks have its proxy as their parent.
std::string pmi_job(const Environment& variable, const Ranks& ranks) {
  const std::string named = first_of(variable, {"PMI_JOBID", "PMIX_NAMESPACE", "PMI_PORT"});
  if (!named.empty()) return named + first_of(variable, {"SLURM_STEP_ID"});
  if (ranks.local_size == ranks.size) return fmt::format("parent {}", getppid());
  throw ConfigError(
      "this launcher (PMI_RANK, PMI_SIZE) does not say which launch the ranks belong to; "
      "set WAVETRACER_JOB to a text that no other run has, the same for all ranks");
}

}  // namespace

uint32_t tasks_of_node(const std::string& list, uint32_t node) {
  uint64_t first = 0;
  for (size_t at = 0; at < list.size();) {
    const std::string item = list.substr(at, list.find(',', at) - at);
    at += item.size() + 1;
    const size_t times = item.find("(x");
    const auto tasks = count_in(item.substr(0, times));
    const auto nodes = times == std::string::npos ? std::optional<uint32_t>(1)
                       : item.ends_with(')')      ? count_in(item.substr(times + 2, item.size() - times - 3))
                                                  : std::nullopt;
    if (!tasks || !nodes) return 0;
    first += *nodes;
    if (node < first) return *tasks;
  }
  return 0;
}

Ranks ranks_of(const Environment& variable) {
  std::optional<Ranks> ranks = from(ours, variable);
  std::string job;
  if (ranks) {
    ranks->started = true;
  } else if ((ranks = from(open_mpi, variable))) {
    job = first_of(variable, {"PMIX_NAMESPACE", "OMPI_MCA_ess_base_jobid"}) + " " +
          first_of(variable, {"OMPI_MCA_orte_hnp_uri", "PMIX_SERVER_URI21", "PMIX_SERVER_URI2"});
  } else if ((ranks = from(pmi, variable))) {
    if (ranks->size > 1 && text_of(variable, "WAVETRACER_JOB").empty()) job = pmi_job(variable, *ranks);
  } else if (const auto step = number_of(variable, "SLURM_STEP_ID"); step && *step <= last_slurm_step) {
    if ((ranks = from(slurm, variable))) {
      const uint32_t tasks = tasks_of_node(text_of(variable, "SLURM_STEP_TASKS_PER_NODE"),
                                           number_of(variable, "SLURM_NODEID").value_or(0));
      ranks->local_size = std::max(ranks->local_size, tasks);
      job = fmt::format("slurm {}.{} {}", text_of(variable, "SLURM_JOB_ID"), *step,
                        text_of(variable, "SLURM_RESTART_COUNT"));
    }
  }
  if (!ranks || (ranks->size == 1 && !ranks->started)) return {};
  const std::string named = text_of(variable, "WAVETRACER_JOB");
  ranks->job = named.empty() ? job : named;
  return *ranks;
}

Ranks ranks_of_this_process() {
  return ranks_of([](const char* name) { return std::getenv(name); });
}

ShardChoice parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  const auto index = count_in(std::string_view(text).substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : count_in(std::string_view(text).substr(slash + 1));
  if (!index || !count || *count == 0 || *count > most_ranks)
    throw ConfigError(
        fmt::format("--shard {}: give K/N, that is part K (from 0 to N - 1) of N parts, with N up to {}; "
                    "parts are counted from 0",
                    text, most_ranks));
  if (*index >= *count)
    throw ConfigError(fmt::format("--shard {}: parts are counted from 0, so the last of {} is {}/{}", text, *count,
                                  *count - 1, *count));
  return {*index, *count};
}

}  // namespace wavetracer
