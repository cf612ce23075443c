// SPDX-License-Identifier: Apache-2.0
// Ranks from the variables of launchers, and --shard.
// Variables are those of Open MPI 4, MPICH's Hydra and Slurm 22.
#include "jobs/ranks.hpp"
#include <doctest/doctest.h>
#include <map>
#include "app/program.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

Ranks ranks(const std::map<std::string, std::string>& variables) {
  return ranks_of([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

}  // namespace

TEST_CASE("without a launcher, or with one rank, there is one process") {
  CHECK(ranks({}).size == 1);
  CHECK(ranks({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "1"}}).size == 1);
  // A batch script is no step.
  CHECK(ranks({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "8"}, {"SLURM_STEP_NUM_TASKS", "8"}}).size == 1);
  CHECK(ranks({{"SLURM_PROCID", "0"}, {"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_STEP_ID", "4294967291"}}).size == 1);
}

TEST_CASE("the only child of a starter knows that it is a child") {
  const Ranks only = ranks({{"WAVETRACER_RANK", "0"}, {"WAVETRACER_RANKS", "1"}, {"WAVETRACER_JOB", "7 ab"}});
  CHECK(only.started);
  CHECK(only.size == 1);
  CHECK(only.job == "7 ab");
  CHECK_FALSE(ranks({{"PMI_RANK", "0"}, {"PMI_SIZE", "1"}}).started);
}

TEST_CASE("ranks of Open MPI, PMI and Slurm") {
  const Ranks mpi = ranks({{"OMPI_COMM_WORLD_RANK", "5"},
                           {"OMPI_COMM_WORLD_SIZE", "8"},
                           {"OMPI_COMM_WORLD_LOCAL_RANK", "1"},
                           {"OMPI_COMM_WORLD_LOCAL_SIZE", "4"},
                           {"OMPI_MCA_ess_base_jobid", "77"}});
  CHECK(mpi.rank == 5);
  CHECK(mpi.size == 8);
  CHECK(mpi.local_rank == 1);
  CHECK(mpi.local_size == 4);
  CHECK(contains(mpi.job, "77"));
  const Ranks pmi = ranks({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}, {"MPI_LOCALRANKID", "1"}, {"MPI_LOCALNRANKS", "2"}});
  CHECK(pmi.rank == 1);
  CHECK(pmi.local_size == 2);
  CHECK_FALSE(pmi.job.empty());
  CHECK_THROWS_WITH_AS(ranks({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}), doctest::Contains("set WAVETRACER_JOB"),
                       ConfigError);
  CHECK(ranks({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}, {"WAVETRACER_JOB", "mine"}}).job == "mine");
  const Ranks slurm = ranks({{"SLURM_PROCID", "9"},
                             {"SLURM_STEP_NUM_TASKS", "11"},
                             {"SLURM_LOCALID", "1"},
                             {"SLURM_NODEID", "2"},
                             {"SLURM_STEP_TASKS_PER_NODE", "4(x2),3"},
                             {"SLURM_JOB_ID", "123"},
                             {"SLURM_STEP_ID", "0"}});
  CHECK(slurm.rank == 9);
  CHECK(slurm.size == 11);
  CHECK(slurm.local_size == 3);
  CHECK(contains(slurm.job, "123.0"));
}

TEST_CASE("variables that contradict each other are refused by name") {
  for (const char* rank : {"2", "-1", "x", "99999999999999"})
    CHECK_THROWS_WITH_AS(ranks({{"PMI_RANK", rank}, {"PMI_SIZE", "2"}}), doctest::Contains("PMI_RANK"), ConfigError);
}

TEST_CASE("Slurm's lists of tasks a node") {
  CHECK(tasks_of_node("4", 0) == 4);
  CHECK(tasks_of_node("4(x2),3", 1) == 4);
  CHECK(tasks_of_node("4(x2),3", 2) == 3);
  for (const char* text : {"", "4", "x", "4(x", "4(x2", "(x2)", ","}) CHECK(tasks_of_node(text, 5) == 0);
}

TEST_CASE("--shard K/N counts from 0; mistakes exit 2 before anything is loaded") {
  CHECK(parse_shard("0/1").count == 1);
  CHECK(parse_shard("1048575/1048576").index == 1048575);
  for (const char* text : {"", "1", "/", "1/", "/2", "a/2", "0/0", "-1/2", "0/1048577", "1/2/3"})
    CHECK_THROWS_WITH_AS(parse_shard(text), doctest::Contains("give K/N"), ConfigError);
  CHECK_THROWS_WITH_AS(parse_shard("2/2"), doctest::Contains("counted from 0, so the last of 2 is 1/2"), ConfigError);
  const Folder folder;
  const std::string file = folder.file("a.toml",
                                       "scene.generate = \"--blocks 2\"\n[[transmitter]]\nname = \"t\"\n"
                                       "position_m = [0, 0, 6]\n[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n");
  const auto check = [&](std::vector<std::string> words, const char* message,
                         const std::vector<std::string>& environment = {}) {
    words.insert(words.begin(), {"run", "-c", file, "-o", folder.path("out")});
    const Outcome outcome = run_program(words, environment);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, message));
    CHECK(folder.entries() == 1);
  };
  check({"--shard", "2/2"}, "counted from 0");
  check({"--shard", "0/2", "--processes", "2"}, "start several: give one or the other");
  check({"--shard", "0/2"}, "is rank 1 of 2 already", {"WAVETRACER_RANK=1", "WAVETRACER_RANKS=2", "WAVETRACER_JOB=j"});
  check({}, "PMI_RANK=7", {"PMI_RANK=7", "PMI_SIZE=2"});
}
