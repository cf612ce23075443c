// SPDX-License-Identifier: Apache-2.0
// `wavetracer events`: refusals before anything is computed, and the table of a drive. The cases that compute are
// skipped with a message if there is no OpenCL device.
#include <doctest/doctest.h>
#include <cstdlib>
#include <sstream>
#include <vector>
#include "program.hpp"

namespace {

namespace fs = std::filesystem;

// A car drives by a lorry that is parked beside it.
const std::string world =
    "scene.generate = \"--blocks 2\"\ntrace.max_depth = 1\ntrace.discovery = \"beams\"\ntime.step_s = 0.5\n"
    "[[transmitter]]\nname = \"mast\"\nposition_m = [0, 3, 2]\n"
    "[[mount]]\nname = \"roof\"\non = \"a\"\nrole = \"receiver\"\noffset_m = [0, 0, 1.6]\n"
    "[[track]]\nid = \"lorry\"\ntype = \"truck\"\nwaypoints = [[0, 15, 0, 0], [3, 15.01, 0, 0]]\n"
    "[[track]]\nid = \"a\"\ntype = \"passenger\"\nwaypoints = [[0, 15, -3, 0], [3, 45, -3, 0]]\n";

std::vector<std::string> rows_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

}  // namespace

TEST_CASE("events are refused without beams, without times, and where lifetimes are") {
  const Folder folder;
  const std::string file = folder.file("a.toml", world);
  const auto refuse = [&](const std::string& set, const std::string& message) {
    const Outcome out = run_program({"events", "-c", file, "-o", folder.path("events.csv"), "--set", set});
    CAPTURE(out.err);
    CHECK(out.code == 2);
    CHECK(contains(out.err, message));
    CHECK_FALSE(fs::exists(folder.path("events.csv")));
  };
  refuse("trace.discovery=rays", "which is no birth: events need trace.discovery = \"beams\"");
  refuse("trace.scattering=true", "set trace.scattering and trace.target to false");
  refuse("trace.floor_db=-130", "remove output.lifetimes, or trace.floor_db");
  const Outcome precision = run_program({"events", "-c", file, "-o", "x.csv", "--precision", "0"});
  CHECK(precision.code == 2);
  CHECK(contains(precision.err, "--precision: 0 is not a number from 1e-09 to 1"));
  CHECK(run_program({"events", "-c", file}).code == 2);
  if (!device_present()) return;
  const Outcome one = run_program({"events", "-c", file, "-o", folder.path("events.csv"), "--frames", "2"});
  CHECK(one.code == 2);
  CHECK(contains(one.err, "there is only one: give trajectories, and --frames A:B"));
}

TEST_CASE("frames that the drive has not are refused before kernels are compiled, by run and events") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", world), none = folder.path("none");
  fs::create_directory(none);
  REQUIRE(setenv("WAVETRACER_KERNEL_DIR", none.c_str(), 1) == 0);  // whoever compiles one fails in another way
  const auto refused = [&](const std::string& command, const std::string& frames, const std::string& why) {
    CAPTURE(command);
    const Outcome out = run_program({command, "-c", file, "-o", folder.path("out"), "--frames", frames});
    CHECK(out.code == 2);
    CHECK(contains(out.err, why));
  };
  for (const char* command : {"run", "events"}) {
    refused(command, "0:99", "--frames 0:99: this run has 7 frames, 0 to 6");
    refused(command, "5:1", "did you mean 1:5?");
  }
  refused("events", "2", "there is only one: give trajectories");
  CHECK(contains(run_program({"events", "-c", file, "-o", folder.path("out")}).err, "is in no folder of"));
  REQUIRE(unsetenv("WAVETRACER_KERNEL_DIR") == 0);
}

TEST_CASE("events of a drive: a table by time, with the names of ends and the paths in words") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", world), csv = folder.path("events.csv");
  const Outcome out = run_program({"events", "-c", file, "-o", csv, "--frames", "1:5"});
  CAPTURE(out.err);
  REQUIRE(out.code == 0);
  CHECK(contains(out.out, "deaths in 4 steps"));
  const std::vector<std::string> lines = rows_of(contents(csv));
  REQUIRE(lines.size() > 1);
  CHECK(lines[0] == "time_s,event,tx,rx,depth,path");
  double before = 0.5;
  int births = 0;
  for (size_t k = 1; k < lines.size(); ++k) {
    CAPTURE(lines[k]);
    const double time_s = std::stod(lines[k]);
    CHECK(time_s >= before);
    CHECK(time_s <= 2.5);
    before = time_s;
    births += contains(lines[k], ",birth,mast,a/roof,");
    CHECK((contains(lines[k], ",birth,mast,a/roof,") || contains(lines[k], ",death,mast,a/roof,")));
    CHECK((contains(lines[k], ",1,reflection:") || contains(lines[k], ",0,line of sight")));
  }
  CHECK(contains(out.out, std::to_string(births) + " births and "));
}
