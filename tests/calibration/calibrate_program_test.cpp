// SPDX-License-Identifier: Apache-2.0
// The program `wavetracer calibrate` in free space, where levels have a closed form, and its refusals. Cases that need
// a device are skipped with a message if there is none.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/program.hpp"
#include "check_contains.hpp"
#include "radio/constants.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A small surface that is far away, so that all is free space.
SceneFile nothing() { return SceneFile({Quad{{-900, -900, -400}, {2, 0, 0}, {0, 2, 0}}}); }

std::string text_of(const SceneFile& scene, const std::string& more) {
  return fmt::format("scene.file = \"{}\"\n[radio]\nfrequency_hz = 1e9\n[trace]\nrays = 1000\nmax_depth = 1\n",
                     scene.path().string()) +
         "[[transmitter]]\nname = \"a\"\nposition_m = [0, 0, 10]\n" + more;
}

double loss_db(double distance_m) {
  return 20 * std::log10(4 * std::acos(-1.0) * distance_m * 1e9 / speed_of_light_m_s);
}

void check_refused(const Outcome& outcome, int code, const std::string& words) {
  CHECK(outcome.code == code);
  check_contains(outcome.err, words);
}

}  // namespace

TEST_CASE("calibrate: only an offset is left in free space, and all files are written") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = nothing();
  const std::string config =
      folder.file("c.toml", text_of(scene, "[[receiver]]\nname = \"r\"\nposition_m = [0, 0, 10]\n"));
  std::string rows = "x,y,path_loss_db,group,note\n";
  for (int i = 1; i <= 20; ++i)
    rows += fmt::format("{},0,{:.12f},{},n\n", 10 * i, loss_db(10 * i) - 3, i % 2 ? "odd" : "even");
  const std::string measured = folder.file("m.csv", rows), out = folder.path("out");
  const Outcome outcome = run_program({"calibrate", "-c", config, "--measured", measured, "-o", out, "--fit", "none"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  check_contains(outcome.out, "20 points, 20 paths found");
  check_contains(outcome.out, "offset of all points  -       3.00 dB");
  check_contains(outcome.out, "these columns are not used: note");
  check_contains(outcome.out, "odd (10)");
  for (const char* name : {"calibration.csv", "calibration.gp", "parameters.csv", "fitted.toml", "calibration.html"})
    CHECK(std::filesystem::exists(out + "/" + name));
  CHECK(lines_of(out + "/calibration.csv") == 21);
  check_contains(contents(out + "/calibration.html"), "offset of all points");
  const Outcome valid = run_program({"validate", "-c", out + "/fitted.toml"});
  CAPTURE(valid.err);
  CHECK(valid.code == 0);
}

TEST_CASE("calibrate: the height of a transmitter in free space, with its standard error, and mistakes in names") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = nothing();
  const std::string config = folder.file("c.toml", text_of(scene, ""));
  std::string rows = "x,y,z,path_loss_db\n";
  for (int i = 1; i <= 20; ++i) rows += fmt::format("{},0,2,{:.12f}\n", 2 * i, loss_db(std::hypot(2 * i, 8.7)));
  const std::string measured = folder.file("m.csv", rows), out = folder.path("out");
  const auto run = [&](const std::string& fit, const std::string& error) {
    return run_program({"calibrate", "-c", config, "--measured", measured, "-o", out, "--fit", fit, "--error", error,
                        "--offset", "none"});
  };
  const Outcome outcome = run("a.height , a.yaw", "a.height=2");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  check_contains(outcome.out, "a.height   10 m    10.7 m");
  check_contains(outcome.out, "frames were solved with ends in other places");
  const std::string fitted = contents(out + "/fitted.toml"), before = "position_m = [0.0, 0.0, ";
  const size_t at = fitted.find(before);
  REQUIRE(at != std::string::npos);
  CHECK(std::abs(std::stod(fitted.substr(at + before.size())) - 10.7) < 1e-6);
  check_refused(run("b.height", "b.height=1"), 2, "no transmitter is called \"b\"; did you mean \"a.height\"?");
  check_refused(run("a.height", "a.x=1"), 2, "no parameter of this name is fitted");
  check_refused(run("a.height", "a.height=wide"), 2, "give NAME=VALUE");
}

TEST_CASE("calibrate: rows name their receiver and turn its antenna") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = nothing();
  const std::string config =
      folder.file("c.toml", text_of(scene,
                                    "[[receiver]]\nname = \"all round\"\nposition_m = [0, 0, 10]\n"
                                    "[[receiver]]\nname = \"panel\"\nposition_m = [0, 0, 10]\nantenna = \"tr38901\"\n"
                                    "orientation_deg = [90, 0, 0]\n"));
  // The element of 3GPP TR 38.901 has 8 dBi ahead, 12 dB less at 65 degrees, and 30 dB less at the back.
  std::string rows = "x,y,path_gain_db,rx,yaw_deg\n";
  for (int i = 1; i <= 5; ++i) {
    const double gain_db = -loss_db(10 * i);
    rows += fmt::format("{0},0,{1:.12f},all round,\n{0},0,{2:.12f},panel,180\n{0},0,{3:.12f},panel,115\n", 10 * i,
                        gain_db, gain_db + 8, gain_db - 4);
    rows += fmt::format("0,{},{:.12f},panel,\n", 10 * i, gain_db - 22);  // as configured: it looks away
  }
  const Outcome outcome = run_program({"calibrate", "-c", config, "--measured", folder.file("m.csv", rows), "-o",
                                       folder.path("out"), "--fit", "none", "--offset", "none"});
  CAPTURE(outcome.err);
  CAPTURE(outcome.out);
  REQUIRE(outcome.code == 0);
  check_contains(outcome.out, "20 points, 20 paths found");
  const std::string before = "as configured  20";
  const size_t row = outcome.out.find(before);
  REQUIRE(row != std::string::npos);
  std::istringstream numbers(outcome.out.substr(row + before.size()));
  double offset_db = 1, sigma_db = 1;
  numbers >> offset_db >> sigma_db;
  CHECK(std::abs(offset_db) < 0.01);
  CHECK(std::abs(sigma_db) < 0.01);
}

TEST_CASE("calibrate: spreads of components beside those of a mirror") {
  if (!device_present()) return;
  const Folder folder;
  // A metal wall at y = 10 beside transmitter and receivers: a wave of sight and one off the wall.
  const SceneFile wall({Part{{Quad{{-900, 10, -900}, {1800, 0, 0}, {0, 0, 1800}}}, "metal"}});
  std::string rows = "position,x,y,z,path_gain_db,delay_ns,azimuth_deg\n";
  for (int i = 1; i <= 5; ++i) {
    const double x = 20 * i;
    const auto add = [&](double distance_m, double azimuth_deg) {
      rows += fmt::format("{},{},0,10,{:.12f},{:.12f},{:.12f}\n", i, x, -loss_db(distance_m),
                          1e9 * distance_m / speed_of_light_m_s, azimuth_deg);
    };
    add(x, 180);
    add(std::hypot(x, 20), 180 - std::atan2(20, x) * 180 / std::acos(-1.0));
  }
  const std::string out = folder.path("out");
  const Outcome outcome = run_program({"calibrate", "-c", folder.file("c.toml", text_of(wall, "")), "--measured",
                                       folder.file("m.csv", rows), "-o", out, "--fit", "none"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  check_contains(outcome.out, "10 components at 5 places");
  std::istringstream table(contents(out + "/calibration.csv"));
  std::string line;
  std::getline(table, line);
  int points = 0;
  for (; std::getline(table, line); ++points) {
    CAPTURE(line);
    std::vector<double> cells;  // from the right: azimuth fitted, before, measured, delay fitted, before, measured
    for (size_t end = line.size(); cells.size() < 6; end = line.rfind(',', end - 1))
      cells.push_back(std::stod(line.substr(line.rfind(',', end - 1) + 1)));
    CHECK(cells[1] == doctest::Approx(cells[2]).epsilon(1e-3));
    CHECK(cells[4] == doctest::Approx(cells[5]).epsilon(1e-3));
    CHECK(cells[2] > 1);
    CHECK(cells[5] > 0.1);
  }
  CHECK(points == 5);
}

TEST_CASE("calibrate: places in the coordinates of a map, for a scene that has a place on the earth") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile ground({Quad{{-900, -900, 0}, {1800, 0, 0}, {0, 1800, 0}}});
  // The scene counts from a point of UTM zone 32, so metres of the map are its metres.
  const std::string reference = ground.path().parent_path().string() + "/georeference.json";
  std::ofstream(reference)
      << R"({"projection": "+proj=utm +zone=32 +ellps=WGS84 +units=m", "offset_m": [-691000, -5334000]})";
  std::string rows = "x,y,height_m,path_gain_db\n";
  for (int i = 1; i <= 5; ++i)
    rows += fmt::format("{},{},10,{:.12f}\n", 691000 + 30 * i, 5334000 + 40 * i, -loss_db(50 * i));
  const std::string config = folder.file("c.toml", text_of(ground, "")), measured = folder.file("m.csv", rows);
  for (const char* crs : {"EPSG:32632", "+proj=utm +zone=32 +ellps=WGS84 +units=m"}) {
    const Outcome outcome =
        run_program({"calibrate", "-c", config, "--measured", measured, "-o", folder.path("out"), "--fit", "none",
                     "--offset", "none", "--crs", crs, "--set", "trace.max_depth=0"});
    CAPTURE(outcome.err);
    CAPTURE(outcome.out);
    REQUIRE(outcome.code == 0);
    check_contains(outcome.out, "5 points, 5 paths found");
    std::istringstream numbers(outcome.out.substr(outcome.out.find("as configured  5") + 16));
    double offset_db = 1, sigma_db = 1;
    numbers >> offset_db >> sigma_db;
    CHECK(std::abs(offset_db) < 0.01);
    CHECK(std::abs(sigma_db) < 0.01);
  }
  std::filesystem::remove(reference);
}

TEST_CASE("calibrate refuses what does not fit together, and says what to do") {
  const Folder folder;
  const SceneFile scene = nothing();
  const std::string config = folder.file("c.toml", text_of(scene, ""));
  const std::string flat = folder.file("flat.csv", "x,y,path_gain_db\n1,2,-80\n");
  const std::string named = folder.file("named.csv", "x,y,z,path_gain_db,tx\n1,2,3,-80,b\n");
  const auto run = [&](const std::string& with, const std::string& file) {
    return run_program({"calibrate", "-c", with, "--measured", file, "-o", folder.path("no")});
  };
  check_refused(run_program({"calibrate", "-c", config}), 2, "--measured");
  check_refused(run(config, folder.path("missing.csv")), 3, "missing.csv");
  check_refused(run(config, flat), 3, "there is no column z_m: add it, or give the height by a [[receiver]]");
  check_refused(run(config, named), 3, "named.csv:2: tx = 'b' is no transmitter of the configuration");
  const std::string two =
      "[[receiver]]\nname = \"r\"\nposition_m = [1, 0, 0]\n[[receiver]]\nname = \"s\"\nposition_m = [2, 0, 0]\n";
  const std::string both = folder.file("two.toml", text_of(scene, two));
  check_refused(run(both, flat), 3,
                "flat.csv:2: the configuration has 2 receivers: name the one of each row in a column rx");
  const std::string other = folder.file("other.csv", "x,y,path_gain_db,rx\n1,2,-80,t\n");
  check_refused(run(both, other), 3, "other.csv:2: rx = 't' is no receiver of the configuration");
  const std::string map = folder.file("map.csv", "x,y,height_m,path_gain_db\n691000,5334000,2,-80\n");
  check_refused(
      run_program({"calibrate", "-c", config, "--measured", map, "--crs", "EPSG:25832", "-o", folder.path("no")}), 2,
      "map.csv:2\": a position in degrees needs a georeference.json");
  const std::string grid = "[[receiver_grid]]\nname = \"g\"\nx_min_m = 0\nx_max_m = 9\ny_min_m = 0\ny_max_m = 9\n";
  check_refused(run(folder.file("grid.toml", text_of(scene, grid)), flat), 2, "measured places are the only receivers");
  CHECK_FALSE(std::filesystem::exists(folder.path("no")));
}

TEST_CASE("calibrate says where no measured place has a path") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile wall({Quad{{5, -900, -900}, {0, 1800, 0}, {0, 0, 1800}}});
  const std::string measured = folder.file("m.csv", "x,y,z,path_gain_db\n9,0,10,-80\n9,1,10,-81\n");
  const Outcome outcome = run_program(
      {"calibrate", "-c", folder.file("c.toml", text_of(wall, "")), "--measured", measured, "-o", folder.path("no")});
  check_refused(outcome, 1, "none of the 2 measured places has a path: look at their coordinates");
  CHECK_FALSE(std::filesystem::exists(folder.path("no")));
}
