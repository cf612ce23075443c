// SPDX-License-Identifier: Apache-2.0
// Drives through the program: a vehicle crosses the room, and the run is interrupted, killed and resumed on its way.
// The cases are skipped with a message if there is no OpenCL device.
#include <doctest/doctest.h>
#include <signal.h>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include "gate.hpp"
#include "output/reader.hpp"
#include "program.hpp"
#include "room_drive.hpp"
#include "same_data.hpp"

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using wavetracer::test::check_same_data;
using wavetracer::test::datasets;
using wavetracer::test::Reader;
using wavetracer::test::slurp;

// 60 frames in 12 shards.
const std::string room = wavetracer::test::room_drive(5.9, 5);

// Checks that all h5 files under a final name, in shards or merged, can be read; returns their number.
size_t readable_files(const fs::path& folder) {
  size_t count = 0;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none)) {
    if (entry.path().extension() != ".h5") continue;
    CAPTURE(entry.path());
    const Reader h5(entry.path());
    REQUIRE(h5.file >= 0);
    if (entry.path().filename().string().ends_with("waypoints.h5")) {
      CHECK(h5.shape("/waypoints/instance") == h5.shape("/waypoints/frame"));
    } else {
      const std::vector<double> offset = h5.numbers("/paths/vertex_offset");
      CHECK(offset.size() == h5.numbers("/paths/delay_s").size() + 1);
      CHECK(offset.back() == static_cast<double>(h5.shape("/vertices/position_m")[0]));
    }
    ++count;
  }
  return count;
}

void wait_for(const Program& program, const std::string& message) {
  for (int i = 0; i < 30000 && !contains(program.messages(), message); ++i) std::this_thread::sleep_for(2ms);
}

void check_same(const fs::path& found, const fs::path& expected) {
  REQUIRE(fs::exists(expected / "waypoints.h5"));
  check_same_data(found, expected, 1000);
}

// The lamp sends ten samples per frame. Each goes from wall to wall of the closed room, or to the vehicle, whose
// positions in the frames are the poses of paths.h5.
void check_waypoints(const Reader& h5, const Reader& paths) {
  const auto frame = h5.numbers("/waypoints/frame"), depth = h5.numbers("/waypoints/depth"),
             kind = h5.numbers("/waypoints/kind"), at = h5.numbers("/waypoints/position_m"),
             instance = h5.numbers("/waypoints/instance"), pose = paths.numbers("/poses/position_m");
  REQUIRE(frame.size() == size_t{60} * 10 * 3);
  size_t wrong = 0, on_vehicle = 0;
  for (size_t i = 0; i < frame.size(); ++i) {
    const double* p = &at[3 * i];
    wrong += frame[i] != static_cast<double>(i / 30) || depth[i] != static_cast<double>(i % 3);
    wrong += kind[i] != (i % 3 == 0 ? 0 : 1);
    if (i % 3 == 0) {
      wrong += std::hypot(p[0] - 1, p[1] - 1, p[2] - 2.5) > 1e-5;
    } else if (instance[i] == 0) {
      const double* centre = &pose[3 * (i / 30)];
      wrong += std::hypot(p[0] - centre[0], p[1] - centre[1]) > std::hypot(0.75, 0.4) + 1e-5 || p[2] > 0.6 + 1e-5;
      ++on_vehicle;
    }
  }
  CHECK(wrong == 0);
  CHECK(on_vehicle > 0);
}

const std::string keep = "output.keep_shards=true";

}  // namespace

TEST_CASE("a drive: every frame, every end, and ranges of frames that cut at the same shards") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("all"), "--set", keep});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(contains(run.out, "vehicles   1 of 1 models"));
  CHECK(contains(run.out, "frames     60 from 0 to 5.9 s in steps of 0.1 s"));
  CHECK(contains(run.out, "asked for in all frames"));
  const Reader h5(folder.path("all/paths.h5"));
  CHECK(h5.shape("/frames/receiver_position_m") == std::vector<hsize_t>{60, 2, 3});
  const std::vector<double> pose = h5.numbers("/poses/position_m");
  REQUIRE(pose.size() == 180);
  // Waypoints give the centre of the footprint, as the model's origin does.
  CHECK(pose[0] == doctest::Approx(3));
  CHECK(pose[3 * 30] == doctest::Approx(3 + 2 * 30 / 59.0));
  CHECK(pose[3 * 30 + 1] == doctest::Approx(2 + 2 * 30 / 59.0));
  const auto summary = nlohmann::json::parse(slurp(folder.path("all/summary.json")));
  CHECK(summary["frames"] == 60);
  CHECK(summary["shards"] == 12);
  CHECK(summary["counts"]["paths"] == h5.shape("/paths/delay_s")[0]);

  CHECK(contains(run.out, "written    " + folder.path("all/paths.h5") + ", " + folder.path("all/waypoints.h5") + ", "));
  const Reader trails(folder.path("all/waypoints.h5"));
  check_waypoints(trails, h5);
  const auto waypoints = trails.shape("/waypoints/frame");

  REQUIRE(run_program({"run", "-c", file, "-o", folder.path("part"), "--frames", "20:32", "--set", keep}).code == 0);
  const Reader part(folder.path("part/paths.h5"));
  CHECK(part.shape("/frames/frame") == std::vector<hsize_t>{13});
  for (const char* shard : {"000020_000024", "000025_000029"}) {
    const std::string name = std::string("/shards/frames_") + shard;
    for (const char* suffix : {".h5", ".waypoints.h5"})
      CHECK(datasets(folder.path("part" + name + suffix)) == datasets(folder.path("all" + name + suffix)));
    CHECK(slurp(folder.path("part" + name + ".csv")) == slurp(folder.path("all" + name + ".csv")));
  }
  const Outcome other = run_program({"run", "-c", file, "-o", folder.path("part"), "--resume"});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "--frames 20:32, this run has 0:59"));
  const Outcome again = run_program({"run", "-c", file, "-o", folder.path("all"), "--resume", "--set", keep});
  CHECK(again.code == 0);
  CHECK(contains(again.err, "all frames are computed already"));
  CHECK(Reader(folder.path("all/waypoints.h5")).shape("/waypoints/frame") == waypoints);
  const Outcome fewer =
      run_program({"run", "-c", file, "-o", folder.path("all"), "--frames", "0:4", "--set", "output.waypoints=0"});
  CHECK(fewer.code == 0);
  CHECK_FALSE(contains(fewer.out, "waypoints"));
  CHECK_FALSE(fs::exists(folder.path("all/waypoints.h5")));
  const Outcome beyond = run_program({"run", "-c", file, "-o", folder.path("part"), "--frames", "50:60"});
  CHECK(beyond.code == 2);
  CHECK(contains(beyond.err, "this run has 60 frames, 0 to 59"));
}

TEST_CASE("a drive that is whole leaves no shards, and --resume knows it, whoever computed it") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  const auto left = [&](const char* out) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path(out) + "/shards"))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  };
  const auto run = [&](const char* out, std::vector<std::string> more) {
    std::vector<std::string> words{"run", "-c", file, "-o", folder.path(out), "--frames", "0:19"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  REQUIRE(run("alone", {}).code == 0);
  CHECK(left("alone") == std::vector<std::string>{"merged.json", "run.json"});
  REQUIRE(run("shared", {"--processes", "2"}).code == 0);
  CHECK(left("shared") == std::vector<std::string>{"job.json", "merged.json", "run.json"});
  const std::string paths = slurp(folder.path("alone/paths.h5"));
  CHECK(slurp(folder.path("shared/paths.h5")) == paths);
  for (const std::vector<std::string>& how : {std::vector<std::string>{"--resume"}, {"--resume", "--processes", "2"}})
    for (const char* out : {"alone", "shared"}) {
      const Outcome again = run(out, how);
      CAPTURE(again.err);
      CHECK(again.code == 0);
      CHECK(contains(again.err, "--resume: the run is complete"));
      CHECK(slurp(folder.path(std::string(out) + "/paths.h5")) == paths);
      CHECK(fs::exists(folder.path(std::string(out) + "/shards/merged.json")));
    }
  const Outcome other = run("alone", {"--resume", "--set", "trace.max_depth=1"});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "trace.max_depth"));
  const Outcome merged = run_program({"merge", folder.path("alone")});
  CHECK(merged.code == 3);
  CHECK(contains(merged.err, "nothing is left to merge"));
}

TEST_CASE("an interrupted drive exits 130 with the frames so far and goes on with --resume") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  REQUIRE(run_program({"run", "-c", file, "-o", folder.path("expected")}).code == 0);
  const Gate gate;
  Program run({"run", "-c", file, "-o", folder.path("out")}, gate.at_name("frames_000010"));
  gate.wait_for(1);
  run.signal(SIGINT);
  wait_until_interrupted(run.id());
  gate.open();
  const Outcome stopped = run.wait();
  CAPTURE(stopped.err);
  CHECK(stopped.code == 130);
  CHECK(contains(stopped.err, "continue with --resume"));
  const auto summary = nlohmann::json::parse(slurp(folder.path("out/summary.json")));
  const size_t frames = summary["frames"];
  CHECK(frames >= 10);
  CHECK(frames < 60);
  CHECK(Reader(folder.path("out/paths.h5")).shape("/frames/frame")[0] == frames);
  const Outcome resumed = run_program({"run", "-c", file, "-o", folder.path("out"), "--resume"});
  CHECK(resumed.code == 0);
  CHECK(contains(resumed.err, "of 60 frames are computed already"));
  check_same(folder.path("out"), folder.path("expected"));
}

TEST_CASE("repeats change the times that are noted, and nothing else that is written") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  // Each frame launches few new rays, so that its result depends on the frames before.
  const std::vector<std::string> words{"run", "-c", file, "--set", keep, "--frames", "0:14", "--set", "trace.rays=200"};
  const auto run = [&](const char* out, const char* repeats) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", folder.path(out), "--repeat", repeats});
    return run_program(all);
  };
  REQUIRE(run("once", "1").code == 0);
  const Outcome thrice = run("thrice", "3");
  CAPTURE(thrice.err);
  REQUIRE(thrice.code == 0);
  CHECK(contains(thrice.out, "each 3 times\n"));
  CHECK_FALSE(contains(thrice.err, "do not trust it"));
  for (const char* name : {"paths.h5", "waypoints.h5", "links.csv"}) {
    CAPTURE(name);
    const bool same =
        slurp(folder.path(std::string("once/") + name)) == slurp(folder.path(std::string("thrice/") + name));
    CHECK(same);
  }
}

TEST_CASE("a drive that is killed fifty times ends as one that was left alone") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", room);
  Program alone({"run", "-c", file, "-o", folder.path("expected")});
  wait_for(alone, "ready after");
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(alone.wait().code == 0);
  const double drive_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  std::mt19937 random(20240501);  // the times of the kills depend on the machine, but their spread does not
  std::uniform_real_distribution<double> moment_s(-0.05 * drive_s, 0.6 * drive_s);
  const std::string out = folder.path("out");
  size_t kills = 0, drives = 0, files = 0;
  while (kills < 50) {
    Program run({"run", "-c", file, "-o", out, "--resume"});
    const double delay_s = moment_s(random);
    if (delay_s > 0) {  // otherwise it is killed while it starts
      wait_for(run, "ready after");
      std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
    }
    run.signal(SIGKILL);
    const Outcome outcome = run.wait();
    files += readable_files(out);
    if (outcome.code == 128 + SIGKILL) {
      ++kills;
      continue;
    }
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);  // it finished before the signal
    check_same(out, folder.path("expected"));
    fs::remove_all(out);
    ++drives;
  }
  const Outcome last = run_program({"run", "-c", file, "-o", out, "--resume"});
  CAPTURE(last.err);
  REQUIRE(last.code == 0);
  check_same(out, folder.path("expected"));
  for (const auto& entry : fs::recursive_directory_iterator(out)) CHECK(entry.path().extension() != ".tmp");
  CHECK(files > 50);  // the kills hit drives in progress
  MESSAGE(kills << " kills, " << drives << " drives finished between them, " << files << " files read");
}
