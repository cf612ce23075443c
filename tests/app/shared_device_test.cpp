// SPDX-License-Identifier: Apache-2.0
// Runs that several processes share give the data of one process, bit for bit, for every split and for every process
// that dies. The cases are skipped with a message if there is no OpenCL device. With mpirun: tests/app/mpirun_test.py.
#include <doctest/doctest.h>
#include <signal.h>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include "gate.hpp"
#include "output/reader.hpp"
#include "program.hpp"
#include "room_drive.hpp"
#include "same_data.hpp"

namespace {

namespace fs = std::filesystem;
using wavetracer::test::check_same_data;
using wavetracer::test::slurp;

// 20 frames in 7 shards.
const std::string room = wavetracer::test::room_drive(1.9, 3);

// One frame of a city: fixed ends, some of which send and receive at one place, with one port and two, and antennas of
// both roles on vehicles.
const std::string city = R"(scene.generate = "--seed 1 --blocks 2x2"
trace.rays = 20000
trace.max_depth = 3
links.i2i = true
links.max_distance_m = 150
[[transmitter]]
name = "mast"
position_m = [8, 8, 6]
polarization = "VH"
[[transmitter]]
name = "lamp"
position_m = [-60, 3, 5]
[[transmitter]]
name = "tower"
position_m = [3, 70, 9]
[[receiver]]
name = "mast-rx"
position_m = [8, 8, 6]
polarization = "VH"
[[receiver]]
name = "walker"
position_m = [50, -3, 1.5]
[[track]]
id = "a"
type = "passenger"
waypoints = [[0, -40, -3, 0], [0.01, -39.9, -3, 0]]
[[track]]
id = "b"
type = "passenger"
waypoints = [[0, 3, -40, 0], [0.01, 3, -39.9, 0]]
[[mount]]
name = "roof"
role = "both"
offset_m = [0, 0, 1.6]
[time]
end_s = 0
step_s = 0.1
)";

Outcome run(const std::string& file, const std::string& out, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"run", "-c", file, "-o", out});
  return run_program(more);
}

// Compares all outputs except times and names of commands.
void check_same(const fs::path& found, const fs::path& expected, bool work_too) {
  check_same_data(found, expected, 200);
  const auto a = nlohmann::json::parse(slurp(found / "summary.json")),
             b = nlohmann::json::parse(slurp(expected / "summary.json"));
  for (const char* key : {"frames", "first_frame", "last_frame", "links", "paths_by_kind", "features", "frames_asked",
                          "vehicles", "start_s", "end_s", "warnings", "device", "repeat_count", "missed"}) {
    CAPTURE(key);
    CHECK(a[key] == b[key]);
  }
  CHECK(a["counts"]["paths"] == b["counts"]["paths"]);
  if (work_too) CHECK(a["counts"] == b["counts"]);
  if (work_too) CHECK(a["segments_per_depth"] == b["segments_per_depth"]);
}

// Files of processes that shared a folder are gone when they are done.
void check_tidy(const fs::path& out) {
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    CHECK_FALSE(name.ends_with(".tmp"));
    CHECK(name.find(".claim.") == std::string::npos);
    CHECK_FALSE(name.starts_with("process_"));
  }
}

}  // namespace

TEST_CASE("two processes, or parts in two folders, write what one process writes") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  REQUIRE(run(file, folder.path("one")).code == 0);
  const Outcome two = run(file, folder.path("two"), {"--processes", "2"});
  CAPTURE(two.err);
  REQUIRE(two.code == 0);
  CHECK(contains(two.out, "frames     20 from 0 to 1.9 s"));
  CHECK(contains(two.err, "rank 0: "));
  CHECK(contains(two.err, "rank 1: "));
  check_same(folder.path("two"), folder.path("one"), true);
  check_tidy(folder.path("two"));

  for (const std::string part : {"0/3", "2/3", "1/3"}) {
    const Outcome outcome = run(file, folder.path("part" + part.substr(0, 1)), {"--shard", part});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.err, "wavetracer merge"));
    CHECK_FALSE(fs::exists(folder.path("part" + part.substr(0, 1)) + "/paths.h5"));
  }
  // There are more parts than shards: the last part is empty, and treated like the others.
  const std::vector<std::string> whole = {"--set", "output.shard_frames=100", "--shard"};
  std::vector<std::string> first = whole, second = whole;
  first.push_back("0/2");
  second.push_back("1/2");
  REQUIRE(run(file, folder.path("full"), first).code == 0);
  const Outcome empty = run(file, folder.path("empty"), second);
  CHECK(empty.code == 0);
  CHECK(contains(empty.err, "--shard 1/2 is done, and it is empty, because the run has fewer parts than N"));
  const Outcome joined = run_program({"merge", "-o", folder.path("joined"), folder.path("empty"), folder.path("full")});
  CAPTURE(joined.err);
  CHECK(joined.code == 0);
  CHECK(fs::exists(folder.path("joined/paths.h5")));

  const Outcome missing =
      run_program({"merge", "-o", folder.path("merged"), folder.path("part0"), folder.path("part2")});
  CHECK(missing.code == 5);
  CHECK(contains(missing.err, "missing: frames 3 to 5, frames 12 to 14"));
  CHECK_FALSE(fs::exists(folder.path("merged")));
  const Outcome merged = run_program(
      {"merge", "-o", folder.path("merged"), folder.path("part1"), folder.path("part0"), folder.path("part2")});
  CAPTURE(merged.err);
  REQUIRE(merged.code == 0);
  check_same(folder.path("merged"), folder.path("one"), true);
  const Outcome partial =
      run_program({"merge", "--partial", "-o", folder.path("some"), folder.path("part0"), folder.path("part2")});
  CHECK(partial.code == 5);
  CHECK(wavetracer::test::Reader(folder.path("some/paths.h5")).shape("/frames/frame") == std::vector<hsize_t>{14});

  // A single process continues where a part has left the folder, and another configuration is refused.
  const Outcome rest = run(file, folder.path("part1"), {"--resume"});
  CHECK(rest.code == 0);
  check_same(folder.path("part1"), folder.path("one"), true);
  const Outcome other = run(file, folder.path("part0"), {"--shard", "1/3", "--set", "trace.rays=2001"});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "trace.rays was 2000 and is 2001"));
}

TEST_CASE("--devices with one device starts one process, which starts no other and writes what a run alone writes") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  REQUIRE(run(file, folder.path("alone"), {"--device", "0"}).code == 0);
  const Outcome one = run(file, folder.path("one"), {"--devices", "0"});
  CAPTURE(one.err);
  REQUIRE(one.code == 0);
  CHECK(contains(one.err, "1 process on device 0"));
  check_same(folder.path("one"), folder.path("alone"), true);
  check_tidy(folder.path("one"));
}

TEST_CASE("blocks of transmitters of one frame: every link as in the whole frame, whatever is computed") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", city);
  const std::vector<std::vector<std::string>> cases = {
      {},
      {"trace.diffraction=true", "trace.max_diffractions=2"},
      {"trace.diffraction=true", "trace.transmission=true", "trace.scattering=true"}};
  for (size_t i = 0; i < cases.size(); ++i) {
    CAPTURE(i);
    std::vector<std::string> sets;
    for (const std::string& set : cases[i]) sets.insert(sets.end(), {"--set", set});
    const std::string one = folder.path("one" + std::to_string(i)), many = folder.path("many" + std::to_string(i));
    const Outcome alone = run(file, one, sets);
    CAPTURE(alone.err);
    REQUIRE(alone.code == 0);
    for (const char* part : {"1/2", "0/2"}) {
      std::vector<std::string> words = sets;
      words.insert(words.end(), {"--shard", part});
      const Outcome outcome = run(file, many, words);
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      CHECK(contains(outcome.err, "block "));
    }
    const Outcome merged = run_program({"merge", many});
    CAPTURE(merged.err);
    REQUIRE(merged.code == 0);
    check_same(many, one, false);
    const auto summary = nlohmann::json::parse(slurp(fs::path(many) / "summary.json"));
    CHECK(summary["shards"] == 5);  // transmitters: three are fixed, two are on vehicles
    CHECK(summary["counts"]["paths"] > 20);
  }
  const Outcome shared = run(file, folder.path("shared"), {"--processes", "2"});
  CAPTURE(shared.err);
  CHECK(shared.code == 0);
  check_same(folder.path("shared"), folder.path("one0"), false);
  const Outcome refused = run(file, folder.path("no"), {"--processes", "2", "--set", "trace.rays=auto"});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "looks at the rays of all transmitters together"));
}

TEST_CASE("a process that is killed loses its part, which another takes over; --resume repairs what is left") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  REQUIRE(run(file, folder.path("one")).code == 0);
  const std::string out = folder.path("out");
  const Gate middle;
  Program parent({"run", "-c", file, "-o", out, "--processes", "2"}, middle.at_name("frames_", "frames_000000_"));
  const pid_t victim = middle.wait_for(2).front();  // its part is computed, but not written
  REQUIRE(kill(victim, SIGKILL) == 0);
  middle.open();
  const Outcome outcome = parent.wait();
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "was ended by signal 9"));
  CHECK(contains(outcome.err, ": taken over from a process that ended too early"));
  check_same(out, folder.path("one"), true);
  check_tidy(out);

  // Both wait with a part each, and have finished one at most.
  const Gate early;
  Program again({"run", "-c", file, "-o", out, "--processes", "2"}, early.at_name("frames_", "frames_000000_"));
  const std::vector<pid_t> both = early.wait_for(2);
  const Outcome refused = run(file, out);
  CHECK(refused.code == 1);
  CHECK(contains(refused.err, "writes there since"));
  again.signal(SIGINT);
  for (const pid_t process : both) wait_until_interrupted(process);
  early.open();
  const Outcome stopped = again.wait();
  CAPTURE(stopped.err);
  CHECK(stopped.code == 130);
  const Outcome resumed = run(file, out, {"--processes", "3", "--resume"});
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
  CHECK(contains(resumed.err, "of 7 parts are computed already"));
  check_same(out, folder.path("one"), true);
  check_tidy(out);
}

TEST_CASE("a run of killed processes that --resume ends leaves nothing of them, whoever resumes") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  REQUIRE(run(file, folder.path("one")).code == 0);
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--resume"}, {"--resume", "--processes", "2"}, {"--resume", "--shard", "0/1"}}) {
    const std::string out = folder.path("out");
    fs::remove_all(out);
    const Gate early;
    Program killed({"run", "-c", file, "-o", out, "--processes", "2"}, early.at_name("frames_", "frames_000000_"));
    for (const pid_t process : early.wait_for(2)) REQUIRE(kill(process, SIGKILL) == 0);
    CHECK(killed.wait().code != 0);
    const Outcome resumed = run(file, out, how);
    CAPTURE(resumed.err);
    CHECK(resumed.code == 0);
    if (how.back() == "0/1") {
      CHECK(run_program({"merge", out}).code == 0);
    } else {
      CHECK(contains(run(file, out, how).err, "the run is complete"));
    }
    check_same(out, folder.path("one"), true);
    check_tidy(out);
  }
}
