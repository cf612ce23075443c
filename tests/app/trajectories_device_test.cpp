// SPDX-License-Identifier: Apache-2.0
// Trajectories through the program: files that are wrong, a generated city with its drive, and every configuration that
// comes with the program. The cases are skipped with a message if there is no OpenCL device.
#include <doctest/doctest.h>
#include <fstream>
#include <sstream>
#include "folders.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;

const std::string good =
    "<fcd-export>\n"
    "  <timestep time=\"0.0\">\n"
    "    <vehicle id=\"a\" x=\"1.000001\" y=\"2\" angle=\"90\" speed=\"10\" type=\"passenger\"/>\n"
    "  </timestep>\n"
    "  <timestep time=\"0.1\">\n"
    "    <vehicle id=\"a\" x=\"2.000001\" y=\"2\" angle=\"90\" speed=\"10\" type=\"passenger\"/>\n"
    "  </timestep>\n"
    "</fcd-export>\n";

// Returns `good` with one text in it replaced.
std::string with(const std::string& text, const std::string& replacement) {
  std::string out = good;
  REQUIRE(contains(out, text));
  return out.replace(out.find(text), text.size(), replacement);
}

const std::string config =
    "scene.generate = \"--blocks 2\"\ntrajectories.file = \"drive.xml\"\ntrace.rays = 500\ntrace.max_depth = 1\n"
    "[[transmitter]]\nname = \"mast\"\nposition_m = [8, 8, 6]\n[[mount]]\nname = \"roof\"\nrole = \"receiver\"\n"
    "offset_m = [0, 0, 1.6]\n";

}  // namespace

TEST_CASE("a trajectory file that is wrong exits 3 with its line, and writes nothing") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", config);
  const auto check = [&](const std::string& drive, int line, const std::string& message) {
    const std::string trajectories = folder.file("drive.xml", drive);
    const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out")});
    CAPTURE(run.err);
    CHECK(run.code == 3);
    CHECK(contains(run.err, "wavetracer: " + trajectories + ":" + std::to_string(line) + ":"));
    CHECK(contains(run.err, message));
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(folder.path("out")));
  };
  check(with("id=\"a\" x=\"2", "id=a x=\"2"), 6, "not well-formed XML");
  check(with("  </timestep>\n</fcd-export>\n", ""), 7, "the file ends before </fcd-export>: let sumo finish");
  check(with("2.000001", "nan"), 6, "<vehicle id=\"a\">: x = 'nan' is not a finite number");
  check(with("time=\"0.1\"", "time=\"-0.1\""), 5, "time goes backwards, from 0 s in line 2 to -0.1 s");
  check(with("time=\"0.1\"", "time=\"0.0\""), 5, "time stands still");
  check(with("type=\"passenger\"", "type=\"spaceship\""), 3, "the vehicle type 'spaceship' is unknown");
  check("time,id,x,y\n0,a,1,2\n0.1,a,1,2\n0.05,a,1,2\n", 4, "time goes backwards, from 0.1 s in line 3 to 0.05 s");
  check("time;id;x;y\n0;a;1;2\n", 1, "separated by commas, not by semicolons");

  // Only the fault makes the run fail.
  folder.file("drive.xml", good);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out")});
  CAPTURE(run.err);
  CHECK(run.code == 0);
  CHECK(lines_of(folder.path("out/links.csv")) == 3);
  folder.file("drive.xml", with("type=\"passenger\"", "type=\"spaceship\""));
  CHECK(run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "trajectories.default_type=bus"}).code == 0);
}

TEST_CASE("--frames of a drive: mistakes exit 2 with the frames that there are, and write nothing") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", config);
  folder.file("drive.xml", good);
  // Kernels that are compiled come into an empty cache, so refused frames leave it without a program.
  const std::string cache = folder.path("cache");
  const auto error_of = [&](const std::string& frames) {
    const Outcome run =
        run_program({"run", "-c", file, "-o", folder.path("out"), "--frames", frames}, {"XDG_CACHE_HOME=" + cache});
    CHECK(run.code == 2);
    CHECK_FALSE(fs::exists(cache + "/wavetracer"));
    CHECK_FALSE(fs::exists(folder.path("out")));
    return run.err;
  };
  CHECK(contains(error_of("0:2"), "--frames 0:2: this run has 2 frames, 0 to 1"));
  CHECK(contains(error_of("1:0"), "did you mean 0:1?"));
  CHECK(contains(error_of("one"), "give the first and the last frame as A:B, A:, :B or A"));
  CHECK(run_program({"run", "-c", file, "-o", folder.path("out"), "--frames", "1:"}).code == 0);
  CHECK(lines_of(folder.path("out/links.csv")) == 2);
}

TEST_CASE("scene city --vehicles writes a drive that validates and runs") {
  if (!device_present()) return;
  const Folder folder;
  const std::string city = folder.path("city"), file = city + "/drive.toml";
  const Outcome made =
      run_program({"scene", "city", "-o", city, "--blocks", "2", "--vehicles", "5", "--seconds", "0.3"});
  CHECK(made.code == 0);
  CHECK(contains(made.out, "drive.fcd.xml: written, 5 vehicles for 0.3 s"));
  const Outcome valid = run_program({"validate", "-c", file});
  CAPTURE(valid.err);
  CHECK(valid.code == 0);
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "trace.rays=1000"});
  CAPTURE(run.err);
  CHECK(run.code == 0);
  CHECK(contains(run.out, "vehicles   5 of "));
  CHECK(contains(run.out, "frames     4 from 0 to 0.3 s in steps of 0.1 s"));
  // Streets are 200 m long: all are within 300 m, five vehicles of each other and of the road-side unit, in four
  // frames.
  CHECK(lines_of(folder.path("out/links.csv")) == 1 + 4 * (5 * 4 + 2 * 5));
}

TEST_CASE("every configuration that comes with the program validates and runs") {
  if (!device_present()) return;
  const Folder folder;
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator(wavetracer::test::source_folder() + "/configs")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string file = entry.path().string(), out = folder.path(entry.path().stem().string());
    CAPTURE(file);
    const Outcome valid = run_program({"validate", "-c", file});
    if (valid.code == 3 && contains(valid.err, "scene.file") && contains(valid.err, "/shared/")) {
      MESSAGE("skipped, its scene is not here: " << file);
      continue;
    }
    CAPTURE(valid.err);
    CHECK(valid.code == 0);
    CHECK(contains(valid.out, ": ok\n"));
    std::vector<std::string> words{
        "run", "-c", file, "-o", out, "--set", "trace.rays=2000", "--set", "trace.refresh_rays=0"};
    if (entry.path().stem() == "coverage_2km")
      words.insert(words.end(), {"--set", "receiver_grid.0.step_m=100", "--set", "trace.edge_rays=20"});
    const Outcome run = run_program(words);
    CAPTURE(run.err);
    if (entry.path().stem() == "live") {
      CHECK(run.code == 2);
      CHECK(contains(run.err, "wavetracer serve -c"));
      continue;
    }
    CHECK(run.code == 0);
    CHECK(lines_of(out + "/links.csv") > 1);
    ++count;
  }
  CHECK(count >= 3);
}
