// SPDX-License-Identifier: Apache-2.0
// The machine fails in the middle of a drive: the device is lost, its memory or the host's is used up, the disk is
// full. Each is an error with a code and advice, and finished work is kept.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <cstdlib>
#include <filesystem>
#include "app/program.hpp"
#include "app/room_drive.hpp"
#include "app/same_data.hpp"
#include "folders.hpp"

namespace {

namespace fs = std::filesystem;
using wavetracer::test::check_same_data;

const std::string drive = wavetracer::test::room_drive(0.9, 2);

using Environment = std::vector<std::string>;

Environment with(Environment faults) {
  faults.push_back("LD_PRELOAD=" WAVETRACER_FAULTS);
  return faults;
}

void check_same(const fs::path& found, const fs::path& expected) { check_same_data(found, expected, 200); }

size_t temporaries(const fs::path& folder) {
  size_t count = 0;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none)) count += entry.path().extension() == ".tmp";
  return count;
}

// Returns the number, at least 1, from which on the fault occurs when some but not all shards of the drive are written.
// It is found by halving: the number of calls of a frame depends on the device.
long in_the_middle(const std::string& file, const Folder& folder, const std::string& variable) {
  long low = 1, high = 1 << 20;
  for (int attempt = 0; attempt < 24; ++attempt) {
    const long middle = (low + high) / 2;
    const std::string out = folder.path("search" + std::to_string(attempt));
    const Outcome outcome =
        run_program({"run", "-c", file, "-o", out}, with({variable + "=" + std::to_string(middle), "FAULT_CODE=-5"}));
    if (outcome.code == 0)
      high = middle;
    else if (!fs::exists(out + "/shards/frames_000000_000001.h5"))
      low = middle;
    else
      return middle;
  }
  return 0;
}

}  // namespace

TEST_CASE("a device that is lost on the way is error 4, and the drive goes on behind the last whole shard") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive), out = folder.path("out");
  REQUIRE(run_program({"run", "-c", file, "-o", folder.path("expected")}).code == 0);
  const long launch = in_the_middle(file, folder, "FAULT_LAUNCH");
  REQUIRE(launch > 0);
  for (const auto& [code, name] : {std::pair{"-2", "CL_DEVICE_NOT_AVAILABLE"},
                                   {"-5", "CL_OUT_OF_RESOURCES"},
                                   {"-36", "CL_INVALID_COMMAND_QUEUE"}}) {
    CAPTURE(name);
    fs::remove_all(out);
    const Outcome lost =
        run_program({"run", "-c", file, "-o", out},
                    with({"FAULT_LAUNCH=" + std::to_string(launch), std::string("FAULT_CODE=") + code}));
    CAPTURE(lost.err);
    CHECK(lost.code == 4);
    CHECK(contains(lost.err, name));
    CHECK(temporaries(out) == 0);
    CHECK(fs::exists(out + "/shards/frames_000000_000001.h5"));
    const Outcome resumed = run_program({"run", "-c", file, "-o", out, "--resume"});
    CHECK(resumed.code == 0);
    CHECK(contains(resumed.err, "of 10 frames are computed already"));
    check_same(out, folder.path("expected"));
  }
}

TEST_CASE("a device without memory for a buffer is error 4 with the size, wherever it happens") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive), out = folder.path("out");
  size_t failed = 0;
  for (const int buffer : {1, 2, 5, 10, 20, 40, 80}) {
    const Outcome full =
        run_program({"run", "-c", file, "-o", out}, with({"FAULT_BUFFER=" + std::to_string(buffer), "FAULT_CODE=-4"}));
    CAPTURE(buffer);
    CAPTURE(full.err);
    if (full.code == 0) continue;  // it needs no more than these
    CHECK(full.code == 4);
    CHECK(contains(full.err, "CL_MEM_OBJECT_ALLOCATION_FAILURE"));
    CHECK(contains(full.err, "trace.batch_rays"));
    CHECK(temporaries(out) == 0);
    ++failed;
  }
  CHECK(failed >= 4);
}

TEST_CASE("a host without memory is error 1, and says what takes it") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive), out = folder.path("out");
  const Outcome full = run_program({"run", "-c", file, "-o", out}, with({"FAULT_MEMORY=60000"}));
  CAPTURE(full.err);
  CHECK(full.code == 1);
  CHECK(contains(full.err, "out of memory"));
  CHECK(temporaries(out) == 0);
}

TEST_CASE("a disk that fills up on a drive is error 1; what was written stays, and --resume ends it") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive), out = folder.path("out");
  REQUIRE(run_program({"run", "-c", file, "-o", folder.path("expected")}).code == 0);
  size_t partly = 0;
  for (const int write : {2, 8, 14, 20, 26, 32, 38}) {
    CAPTURE(write);
    fs::remove_all(out);
    const Outcome full = run_program({"run", "-c", file, "-o", out}, with({"FAULT_DISK=" + std::to_string(write)}));
    CAPTURE(full.err);
    if (full.code == 0) continue;  // it writes less often
    CHECK(full.code == 1);
    CHECK(contains(full.err, "No space left"));
    CHECK(contains(full.err, "free some space"));
    CHECK(temporaries(out) == 0);
    partly += fs::exists(out + "/shards/frames_000000_000001.h5");
    const Outcome resumed = run_program({"run", "-c", file, "-o", out, "--resume"});
    CAPTURE(resumed.err);
    CHECK(resumed.code == 0);
    check_same(out, folder.path("expected"));
  }
  CHECK(partly >= 2);
}

namespace {

// As `ulimit -v` sets it in a shell, in KiB.
Outcome run_limited(long limit, const std::string& file, const Folder& folder) {
  const std::string out = folder.path("limited.out"), err = folder.path("limited.err");
  const std::string command = "ulimit -v " + std::to_string(limit) + " && exec " + wavetracer::test::program() +
                              " run -c " + file + " -o " + folder.path("limited") + " > " + out + " 2> " + err;
  Outcome outcome;
  const int status = std::system(("sh -c '" + command + "'").c_str());
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.err = contents(err);
  return outcome;
}

}  // namespace

TEST_CASE("with too little memory for the process every end has a code and a message, and no signal ends it") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive);
  size_t failed = 0;
  for (long limit = 100000; limit <= 1000000; limit += limit < 400000 ? 100000 : 50000) {
    std::filesystem::remove_all(folder.path("limited"));
    const Outcome outcome = run_limited(limit, file, folder);
    CAPTURE(limit);
    CAPTURE(outcome.err);
    failed += outcome.code != 0;
    CHECK((outcome.code == 0 || outcome.code == 1 || outcome.code == 4));
    if (outcome.code == 0) continue;
    CHECK(contains("\n" + outcome.err, "\nwavetracer: "));  // libraries may print something, too
    CHECK(contains(outcome.err, "memory"));
  }
  CHECK(failed > 0);
}
