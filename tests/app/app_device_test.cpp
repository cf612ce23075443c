// SPDX-License-Identifier: Apache-2.0
// The program on an OpenCL device: devices, a whole run, a wrong --device, an interrupt.
// The cases are skipped with a message if there is no device.
#include <doctest/doctest.h>
#include <signal.h>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include "folders.hpp"
#include "gate.hpp"
#include "program.hpp"

namespace {

const std::string street =
    "scene.generate = \"--blocks 2\"\ntrace.rays = 20000\ntrace.max_depth = 2\n"
    "[[transmitter]]\nname = \"mast\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"car\"\nposition_m = [50, 0, 2]\n";

}  // namespace

TEST_CASE("devices --check says what each device computes, and refuses no sound one") {
  if (!device_present()) return;
  const Outcome checked = run_program({"devices", "--check", "--device", "0"});
  CAPTURE(checked.out);
  CHECK(checked.code == 0);
  CHECK(contains(checked.out, "    traversal  right"));
  CHECK(contains(checked.out, "    ray cache  right"));
  CHECK(contains(checked.out, "  All that was checked is right.\n"));
  CHECK(!contains(checked.out, "WRONG"));
  CHECK(run_program({"devices", "--check", "--device", "no such device"}).code == 4);
  CHECK(run_program({"devices", "--device", "0"}).code == 2);  // a list contains all devices
}

TEST_CASE("devices marks the device that a run takes") {
  if (!device_present()) return;
  const Outcome devices = run_program({"devices"});
  CHECK(contains(devices.out, "platform"));
  CHECK(contains(devices.out, "\n*  "));
  CHECK(devices.err.empty());
}

TEST_CASE("a device is there where caches cannot be written, and if not, the message names PoCL's cache") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a file", "");  // so that no file can be made below it, even by root
  std::filesystem::create_directory(folder.path("tmp"));
  const std::vector<std::string> unwritable = {"HOME=" + file, "XDG_CACHE_HOME=" + file + "/cache",
                                               "TMPDIR=" + folder.path("tmp")};
  const auto with = [&unwritable](const std::string& more) {
    std::vector<std::string> all = unwritable;
    all.push_back(more);
    return all;
  };
  const Outcome elsewhere = run_program({"devices"}, with("POCL_CACHE_DIR="));
  CAPTURE(elsewhere.err);
  CHECK(elsewhere.code == 0);
  if (!elsewhere.err.empty()) CHECK(contains(elsewhere.err, "set POCL_CACHE_DIR to choose a folder"));
  const Outcome chosen = run_program({"devices"}, with("POCL_CACHE_DIR=" + file + "/pocl"));
  if (chosen.code == 0) return;  // PoCL's device was not chosen
  CHECK(chosen.code == 4);
  CHECK(contains(chosen.err, "set POCL_CACHE_DIR to a folder that can be written to"));
  CHECK(contains(chosen.err, file + ": not a folder"));
}

TEST_CASE("the first frame on a machine is not one of compiling") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "trace.max_depth=1"},
                                  {"XDG_CACHE_HOME=" + folder.path("x"), "POCL_CACHE_DIR=" + folder.path("p")});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK_FALSE(contains(run.err, "warning"));
  const auto seconds = nlohmann::json::parse(std::ifstream(folder.path("out/summary.json")))["seconds"];
  const double compiling_s = seconds["compile"].get<double>() + seconds["device check"].get<double>();
  if (compiling_s < 1) return;  // the device compiles too fast for this test
  CHECK(seconds["frame"].get<double>() < 0.1 * compiling_s);
}

TEST_CASE("a run writes three files and says what it found") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out"), "--repeat", "3", "--verbose"});
  CAPTURE(run.err);
  CHECK(run.code == 0);
  CHECK(contains(run.out, "rays       20,000 launched"));
  CHECK(contains(run.out, "median of 3"));
  CHECK(contains(run.out, "mast -> car"));
  CHECK(contains(run.out, "links      1 asked for, 1 with a path (100%), 1 in line of sight (100%)"));
  CHECK(contains(run.out, "compiled   in "));
  CHECK(contains(run.out, folder.path("out/paths.h5")));
  CHECK_FALSE(contains(run.err, "\x1b"));  // no terminal, no escape sequences
  for (const char* name : {"out/paths.h5", "out/links.csv", "out/summary.json"})
    CHECK(std::filesystem::file_size(folder.path(name)) > 0);
  CHECK(lines_of(folder.path("out/links.csv")) == 2);
}

TEST_CASE("a run says which paths it leaves out of paths.h5, or that the device has summed all of them") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const auto out_of = [&](const char* limit) {
    return run_program({"run", "-c", file, "-o", folder.path("out"), "--set", limit}).out;
  };
  CHECK(contains(out_of("output.paths=false"), "left out   all paths are summed in links.csv, and paths.h5 has none"));
  CHECK(lines_of(folder.path("out/links.csv")) == 2);
  CHECK(contains(out_of("output.max_paths_per_link=1"), "are not in paths.h5, as output.min_gain_db"));
  CHECK_FALSE(contains(out_of("output.paths=true"), "left out "));
}

TEST_CASE("a run warns before it traces, and explains links without a path, on the terminal and in summary.json") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street + "[[receiver]]\nname = \"deep\"\nposition_m = [9, 0, -1.5]\n");
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run", "-c", file, "-o", folder.path("out")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome run = run_program(words);
    CHECK(run.code == 0);
    std::ifstream in(folder.path("out/summary.json"));
    const auto all = nlohmann::json::parse(in).at("warnings").get<std::vector<std::string>>();
    for (const std::string& text : all) CHECK(contains(run.err, "warning: " + text + "\n"));
    if (more.empty()) CHECK(run.err.find("warning: receiver \"deep\"") < run.err.find("writing to"));
    return all;
  };
  const std::string deep =
      "receiver \"deep\" is 1.5 m below the ground there, \"ground\"; above = \"ground\" lets its height count from "
      "the ground";
  CHECK(warnings({}) == std::vector<std::string>{deep,
                                                 "mast -> deep has no path: its direct line meets \"ground\" "
                                                 "(concrete) after 9.372 m; "
                                                 "trace.transmission = true lets it through 1 wall"});
  const auto none = warnings({"--set", "links.receivers=[\"deep\"]"});
  REQUIRE(none.size() == 3);
  CHECK(none[1] == "no path was found, of 1 links in 1 frame");
  CHECK(warnings({"--set", "trace.transmission=true"}) == std::vector<std::string>{deep});
  CHECK(warnings({"--processes", "2", "--set", "links.receivers=[\"deep\"]"}) == none);
}

TEST_CASE("a small stack is enough to begin with") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const std::string command = "ulimit -s 64 && exec '" + wavetracer::test::program() + "' run -c '" + file + "' -o '" +
                              folder.path("out") + "' > '" + folder.path("said") + "' 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(std::filesystem::file_size(folder.path("out/paths.h5")) > 0);
}

TEST_CASE("a run says which features it had, why not others, and how many paths of each kind it found") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const auto run = [&](const std::vector<std::string>& sets) {
    std::vector<std::string> words = {"run", "-c", file, "-o", folder.path("out")};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    const Outcome outcome = run_program(words);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    return outcome.out;
  };
  const auto summary = [&] { return nlohmann::json::parse(std::ifstream(folder.path("out/summary.json"))); };
  CHECK(contains(run({}), "\nfeatures   reflection\n"));
  CHECK(summary()["features"]["diffraction"] == nlohmann::json{{"on", false}, {"reason", "trace.diffraction = false"}});
  const std::string out = run({"trace.diffraction=true", "trace.transmission=true", "trace.scattering=true"});
  CHECK(contains(out, "\nfeatures   reflection, transmission, diffraction; no scattering: no material "));
  CHECK(contains(out, " diffracted\n"));
  const nlohmann::json after = summary(), kinds = after["paths_by_kind"];
  CHECK(after["features"]["diffraction"] == nlohmann::json{{"on", true}});
  CHECK(contains(after["features"]["scattering"]["reason"], "scattering coefficient"));
  CHECK(kinds["line_of_sight"] == 1);
  CHECK(kinds["diffracted"] > 0);
  CHECK(kinds["scattered"] == 0);
  uint64_t sum = 0;
  for (const auto& [kind, count] : kinds.items()) sum += count.get<uint64_t>();
  CHECK(after["counts"]["paths"] == sum);
}

TEST_CASE("a run with output.waypoints writes a fourth file, and one without takes it away again") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street), waypoints = folder.path("out/waypoints.h5");
  const Outcome with = run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "output.waypoints=5"});
  CAPTURE(with.err);
  CHECK(with.code == 0);
  CHECK(contains(with.out, ", " + waypoints + ", "));
  CHECK(std::filesystem::exists(waypoints));
  const Outcome without = run_program({"run", "-c", file, "-o", folder.path("out")});
  CHECK(without.code == 0);
  CHECK_FALSE(contains(without.out, "waypoints"));
  CHECK_FALSE(std::filesystem::exists(waypoints));
  CHECK(std::filesystem::exists(folder.path("out/paths.h5")));
}

TEST_CASE("output.directory is relative to the current folder, as -o is") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", "output.directory = \"results\"\n" + street);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::create_directory(folder.path("here"));
  std::filesystem::current_path(folder.path("here"));
  const Outcome run = run_program({"run", "-c", file, "--set", "trace.rays=100"});
  std::filesystem::current_path(before);
  CHECK(run.code == 0);
  CHECK(contains(run.out, folder.path("here/results/links.csv")));
  CHECK(std::filesystem::exists(folder.path("here/results/links.csv")));
}

TEST_CASE("a device that is not there exits 4 with the list of those that are") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out"), "--device", "no such device"});
  CHECK(run.code == 4);
  CHECK(contains(run.err, "no such device"));
  CHECK(run.out.empty());
  CHECK(folder.entries() == 1);
}

TEST_CASE("an interrupt ends the run after the repeat in progress, with whole files and exit code 130") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  Gate gate;
  Program run({"run", "-c", file, "-o", folder.path("out"), "--repeat", "1000000"}, gate.at_launches());
  gate.let_launch(1000, run);  // some repeats
  run.signal(SIGINT);
  wait_until_interrupted(run.id());
  gate.open();
  const Outcome outcome = run.wait();
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(contains(outcome.err, "interrupted after "));
  CHECK(lines_of(folder.path("out/links.csv")) == 2);
}

TEST_CASE("while the scene is loaded Ctrl-C and SIGTERM end a run at once, and leave nothing") {
  if (!device_present()) return;
  const Folder folder;
  // The scattering makes some 10^7 tiles, which take a while.
  const std::string tiles = "trace.scattering = true\ntrace.tile_m = 0.1\n";
  const std::string file =
      folder.file("a.toml", tiles + street + "[[material]]\nname = \"concrete\"\nscattering = 0.3\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    Program run({"run", "-c", file, "-o", folder.path("out")});
    using namespace std::chrono_literals;
    for (int i = 0; i < 3000 && !contains(run.messages(), "loading the scene"); ++i) std::this_thread::sleep_for(20ms);
    run.signal(signal);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run.wait();
    CAPTURE(outcome.err);
    CHECK(std::chrono::steady_clock::now() - start < 5s);
    CHECK(outcome.code == 130);
    CHECK(contains(outcome.err, "interrupted before the first frame; nothing was written"));
    CHECK_FALSE(contains(outcome.err, "ready after"));
    CHECK_FALSE(std::filesystem::exists(folder.path("out")));
  }
}

TEST_CASE("a run of one frame acknowledges Ctrl-C at once and stops between batches of rays") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  Gate gate;
  Program run(
      {"run", "-c", file, "-o", folder.path("out"), "--set", "trace.rays=1000000000"},  // the run would take minutes
      gate.at_launches());
  while (!contains(run.messages(), "ready after") && !run.ended()) gate.let_launch(10, run);
  gate.let_launch(10, run);  // some batches
  run.signal(SIGINT);
  wait_until_interrupted(run.id());
  gate.open();
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run.wait();
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(contains(outcome.err, "interrupted: stopping after the step in progress"));
  CHECK(contains(outcome.err, "interrupted before the first frame; nothing was written"));
  CHECK_FALSE(std::filesystem::exists(folder.path("out/links.csv")));
}

TEST_CASE("a run says what it replaces, and removes a page of the run before") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const std::vector<std::string> words = {"run", "-c", file, "-o", folder.path("out"), "--set", "trace.rays=1000"};
  CHECK_FALSE(contains(run_program(words).err, "replaces"));
  std::ofstream(folder.path("out/view.html")) << "old";
  const Outcome again = run_program(words);
  CHECK(contains(again.err,
                 "replaces paths.h5, links.csv, summary.json, view.html of an earlier run in " + folder.path("out")));
  CHECK_FALSE(std::filesystem::exists(folder.path("out/view.html")));
  std::filesystem::create_directory(folder.path("out/plots"));
  CHECK(
      contains(run_program(words).err, "; the figures in plots stay those of that run until `wavetracer plot` draws"));
}
