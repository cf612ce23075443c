// SPDX-License-Identifier: Apache-2.0
// Files on the disk between and after runs: files equal byte by byte however the work was shared, inputs that change or
// move, two runs that want one folder, folders where files should be. The cases are skipped with a message if there is
// no OpenCL device.
#include <doctest/doctest.h>
#include <signal.h>
#include <ctime>
#include <fstream>
#include "folders.hpp"
#include "gate.hpp"
#include "output/reader.hpp"
#include "program.hpp"
#include "room_drive.hpp"

namespace {

namespace fs = std::filesystem;
using wavetracer::test::slurp;

// The drive has 8 frames in 4 shards.
template <class... Scene>
std::string drive(const Scene&... scene) {
  return wavetracer::test::room_drive(0.7, 2, scene...);
}

Outcome run(const std::string& file, const std::string& out, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"run", "-c", file, "-o", out});
  return run_program(more);
}

void check_same_bytes(const fs::path& found, const fs::path& expected) {
  for (const char* name : {"paths.h5", "waypoints.h5", "links.csv"}) {
    CAPTURE(found / name);
    const std::string bytes = slurp(expected / name);
    CHECK(bytes.size() > 300);
    const bool same = slurp(found / name) == bytes;
    CHECK(same);
  }
}

// Copies the room into another folder; returns the path of its scene file.
std::string room_in(const Folder& folder, const std::string& name) {
  fs::copy(wavetracer::test::source_folder() + "/configs/scenes/room", folder.path(name), fs::copy_options::recursive);
  return folder.path(name + "/room.xml");
}

void change(const fs::path& file) { std::ofstream(file, std::ios::app) << "\n"; }

// Waits until files that contain the time of their making, in seconds, would differ.
void wait_for_next_second() {
  const std::time_t now = std::time(nullptr);
  wait_until("the next second", [now] { return std::time(nullptr) > now; });
}

}  // namespace

TEST_CASE("files are the same byte by byte: processes, shards merged, a kill and --resume, other folders") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive()), one = folder.path("one");
  REQUIRE(run(file, one).code == 0);
  wait_for_next_second();
  REQUIRE(run(file, folder.path("two"), {"--processes", "2"}).code == 0);
  check_same_bytes(folder.path("two"), one);
  for (const char* part : {"1/2", "0/2"})
    REQUIRE(run(file, folder.path(std::string("part") + part[0]), {"--shard", part}).code == 0);
  REQUIRE(run_program({"merge", "-o", folder.path("all"), folder.path("part0"), folder.path("part1")}).code == 0);
  check_same_bytes(folder.path("all"), one);

  const Gate gate;
  Program killed({"run", "-c", file, "-o", folder.path("killed")}, gate.at_name("frames_000002"));
  gate.wait_for(1);
  killed.signal(SIGKILL);
  killed.wait();
  const Outcome resumed = run(file, folder.path("killed"), {"--resume"});
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
  CHECK(contains(resumed.err, "--resume: 2 of 8 frames are computed already"));
  check_same_bytes(folder.path("killed"), one);
}

TEST_CASE("files are the same byte by byte for other shard sizes, where frames do not reuse sequences") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive());
  for (const char* frames : {"2", "3", "100"}) {
    const std::string out = folder.path(frames), set = std::string("output.shard_frames=") + frames;
    REQUIRE(run(file, out, {"--set", "trace.reuse=false", "--set", set}).code == 0);
    check_same_bytes(out, folder.path("2"));
  }
}

TEST_CASE("inputs that changed are named by --resume and merge, and may have moved") {
  if (!device_present()) return;
  const Folder folder;
  const std::string scene = room_in(folder, "room"), moved = room_in(folder, "moved"), other = room_in(folder, "other");
  const std::string file = folder.file("a.toml", drive(scene)), out = folder.path("out");
  const std::string mesh = folder.path("room/room.ply");
  REQUIRE(run(file, out, {"--shard", "0/2"}).code == 0);
  const std::string content = slurp(mesh);
  change(mesh);
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--resume"}, {"--shard", "1/2"}, {"--processes", "2", "--resume"}}) {
    const Outcome refused = run(file, out, how);
    CAPTURE(refused.err);
    CHECK(refused.code == 3);
    CHECK(contains(refused.err, mesh + " (scene.file: room.ply) has changed"));
    CHECK(contains(refused.err, "put the input files back"));
  }
  std::ofstream(mesh, std::ios::binary) << content;

  change(folder.path("other/room.xml"));
  REQUIRE(run(folder.file("other.toml", drive(other)), folder.path("rest"), {"--shard", "1/2"}).code == 0);
  const Outcome mixed = run_program({"merge", "-o", folder.path("all"), out, folder.path("rest")});
  CHECK(mixed.code == 3);
  CHECK(contains(mixed.err, "other/room.xml (scene.file) has changed"));
  CHECK_FALSE(fs::exists(folder.path("all")));

  // The same contents in another place count as the same inputs.
  REQUIRE(run(folder.file("moved.toml", drive(moved)), folder.path("rest"), {"--shard", "1/2"}).code == 0);
  const Outcome merged = run_program({"merge", "-o", folder.path("all"), out, folder.path("rest")});
  CAPTURE(merged.err);
  CHECK(merged.code == 0);
  REQUIRE(run(file, folder.path("one")).code == 0);
  check_same_bytes(folder.path("all"), folder.path("one"));

  CHECK_FALSE(contains(run_program({"view", folder.path("one")}).err, "has changed"));
  change(mesh);
  const std::string warning = mesh + " (scene.file: room.ply) has changed since the run";
  CHECK(contains(run_program({"view", folder.path("one")}).err, warning));
  CHECK(contains(run_program({"plot", folder.path("one")}).err, warning));
  CHECK(contains(run_program({"convert", folder.path("one"), "-o", folder.path("one.glb")}).err, warning));
}

TEST_CASE(
    "a trajectory, an antenna pattern and the mesh of a vehicle count as inputs, and so does every file they name") {
  if (!device_present()) return;
  const Folder folder;
  const std::string scene = room_in(folder, "room");
  folder.file("drive.csv", "time,id,x,y,type\n0,a,3,2,passenger\n0.7,a,5,4,passenger\n");
  folder.file("box.obj",
              "usemtl metal\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n"
              "f 2 3 4\n");
  std::string pattern = "theta_deg,phi_deg,v_re,v_im,h_re,h_im\n";
  for (const int theta : {0, 90, 180})
    for (const int phi : {0, 90, 180, 270}) pattern += std::to_string(theta) + "," + std::to_string(phi) + ",1,0,0,0\n";
  folder.file("lamp.csv", pattern);
  std::string text = drive(scene);
  const auto put = [&text](const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
  };
  put("[[track]]\nid = \"truck\"\ntype = \"passenger\"\nwaypoints = [[0, 3, 2, 0], [0.7, 5, 4, 0]]\n",
      "[trajectories]\nfile = \"drive.csv\"\n");
  put("antenna = \"isotropic\"", "antenna = \"lamp.csv\"");
  put("height_m = 0.6", "height_m = 0.6\nmodel = \"box.obj\"");
  const std::string file = folder.file("a.toml", text), out = folder.path("out");
  const Outcome first = run(file, out, {"--shard", "0/2"});
  CAPTURE(first.err);
  REQUIRE(first.code == 0);
  for (const char* name : {"drive.csv", "lamp.csv", "box.obj", "room/room.xml"}) {
    const std::string content = slurp(folder.path(name));
    change(folder.path(name));
    const Outcome refused = run(file, out, {"--resume"});
    CAPTURE(refused.err);
    CHECK(refused.code == 3);
    CHECK(contains(refused.err, std::string(name) + " ("));
    std::ofstream(folder.path(name), std::ios::binary) << content;
  }
  const Outcome resumed = run(file, out, {"--resume"});
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
}

TEST_CASE("a folder that a run writes to is refused to all others, and free when that run is killed") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive()), out = folder.path("out"), expected = folder.path("expected");
  REQUIRE(run(file, expected).code == 0);
  const Gate gate;
  Program first({"run", "-c", file, "-o", out}, gate.at_name("frames_"));
  gate.wait_for(1);
  for (const std::vector<std::string>& how : {std::vector<std::string>{"run", "-c", file, "-o", out},
                                              {"run", "-c", file, "-o", out, "--resume"},
                                              {"run", "-c", file, "-o", out, "--processes", "2"},
                                              {"run", "-c", file, "-o", out, "--shard", "0/2"},
                                              {"merge", out},
                                              {"merge", "-o", out, expected}}) {
    const Outcome refused = run_program(how);
    CAPTURE(refused.err);
    CHECK(refused.code == 1);
    CHECK(contains(refused.err, " writes there since 2"));
  }
  first.signal(SIGKILL);
  first.wait();
  const Outcome next = run(file, out);
  CAPTURE(next.err);
  CHECK(next.code == 0);
  check_same_bytes(out, expected);

  const Gate second;
  Program part({"run", "-c", file, "-o", folder.path("parts"), "--shard", "0/2"}, second.at_name("frames_"));
  second.wait_for(1);
  const Outcome twice = run(file, folder.path("parts"), {"--shard", "0/2"});
  CAPTURE(twice.err);
  CHECK(twice.code == 1);
  part.signal(SIGKILL);
  part.wait();
}

TEST_CASE("folders where files should be are errors in our words") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", drive()), part = folder.path("part");
  REQUIRE(run(file, part, {"--shard", "0/2"}).code == 0);
  for (const char* name :
       {"shards/job.json", "shards/run.json", "shards/manifest.jsonl", "shards/manifest.0_of_2.jsonl",
        "shards/frames_000000_000001.h5", "shards/frames_000000_000001.csv", "paths.h5", "links.csv", "summary.json",
        "shards/prepare_x.claim.1", "shards/process_x"}) {
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--processes", "2"}, {"--resume"}, {"--shard", "1/2"}, {}}) {
      const std::string out = folder.path("out");
      fs::remove_all(out);
      fs::copy(part, out, fs::copy_options::recursive);
      fs::remove(out + "/" + name);
      fs::create_directories(out + "/" + name + "/inner");
      const Outcome outcome = run(file, out, how);
      CAPTURE(name);
      CAPTURE(outcome.err);
      CHECK((outcome.code == 0 || outcome.code == 1));
      if (outcome.code == 1) CHECK(contains(outcome.err, out + "/" + name));
      for (const char* theirs : {"basic_", "filesystem error", "iostream", "terminate", "json.exception"})
        CHECK_FALSE(contains(outcome.err, theirs));
      if (!how.empty()) continue;
      const Outcome merged = run_program({"merge", "--partial", "-o", out, part, out});
      CAPTURE(merged.err);
      CHECK((merged.code == 0 || merged.code == 5 || merged.code == 1 || merged.code == 3));
      for (const char* theirs : {"basic_", "filesystem error", "iostream", "terminate", "json.exception"})
        CHECK_FALSE(contains(merged.err, theirs));
    }
  }
}
