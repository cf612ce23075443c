// SPDX-License-Identifier: Apache-2.0
// configs/sumo in its two commands: SUMO's vehicles stay in the streets, the houses are those of the polygons, and
// paths are found. The folder is copied first, since SUMO writes beside its configuration. The test is skipped without
// sumo or a device.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "app/program.hpp"
#include "base/file.hpp"
#include "folders.hpp"
#include "imports/imports.hpp"
#include "imports/map.hpp"
#include "imports/rings.hpp"
#include "motion/read.hpp"

namespace {

namespace fs = std::filesystem;
using namespace wavetracer;

const fs::path source = fs::path(test::source_folder()) / "configs/sumo";

// Distance from the nearest street axis: they are 120 m apart, and end at 0 and 240. Lanes are 3.2 m wide, houses stand
// 12 m from the axis. A crossing is a square of 14.4 m, in which turning vehicles, above all the middle of a bus, cut
// the corner.
double from_axis(double x) { return std::abs(x - 120 * std::clamp(std::round(x / 120), 0.0, 2.0)); }

}  // namespace

TEST_CASE("the scene of the town is what the import makes of its polygons") {
  const Folder folder;
  ImportOptions options;
  options.output = folder.path("scene");
  const ImportSummary summary = import_city(source / "town.poly.xml", options);
  CHECK(summary.left_out.empty());
  CHECK(summary.guessed.empty());
  CHECK(summary.courtyards == 1);
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path("scene"))) {
    if (!entry.is_regular_file()) continue;
    const fs::path committed = source / "scene" / fs::relative(entry.path(), folder.path("scene"));
    CAPTURE(committed.string());
    CHECK(read_file(entry.path()) == read_file(committed));
    ++files;
  }
  CHECK(files > 25);
}

TEST_CASE("SUMO to channels in two commands") {
  const std::string sumo = WAVETRACER_SUMO;
  if (sumo.empty()) {
    MESSAGE("skipped: no sumo (Debian: sumo)");
    return;
  }
  if (!device_present()) return;
  const Folder folder;
  const fs::path town = fs::path(folder.path("configs")) / "sumo";
  fs::create_directories(town.parent_path());
  fs::copy(source, town, fs::copy_options::recursive);
  fs::remove(town / "town.fcd.xml");  // left by somebody who tried it
  REQUIRE(std::system((sumo + " -c '" + (town / "town.sumocfg").string() + "' > /dev/null 2>&1").c_str()) == 0);

  const Trajectories drive = read_trajectories(town / "town.fcd.xml", {});
  const imports::Map map = imports::read_sumo_polygons(read_file(town / "town.poly.xml"), "town.poly.xml");
  CHECK(drive.first_time_s == 20);
  CHECK(drive.last_time_s == doctest::Approx(25));
  CHECK(drive.step_s == doctest::Approx(0.1));
  CHECK(drive.tracks.size() >= 30);
  std::set<std::string> types;
  for (const Track& track : drive.tracks) {
    types.insert(drive.types[track.type].name);
    for (const Sample& sample : track.samples) {
      const double x = sample.position_m.x, y = sample.position_m.y;
      const double street = std::min(from_axis(x), from_axis(y)), crossing = std::max(from_axis(x), from_axis(y));
      CAPTURE(track.id);
      CAPTURE(x);
      CAPTURE(y);
      CHECK((street < 4 || crossing < 7.2));
      for (const imports::Footprint& house : map.footprints) {
        const imports::Point p{std::llround(x * imports::grid_per_m), std::llround(y * imports::grid_per_m)};
        CHECK_FALSE(imports::contains(imports::make_ring(house.outer), p));
      }
    }
  }
  CHECK(types == std::set<std::string>{"bus", "passenger", "truck"});

  const Outcome run = run_program({"run", "-c", (town / "town.toml").string(), "-o", folder.path("out/town")});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const auto summary = nlohmann::json::parse(read_file(fs::path(folder.path("out")) / "town/summary.json"));
  CHECK(summary["counts"]["paths"].get<uint64_t>() > 100000);
  const std::string links = read_file(fs::path(folder.path("out")) / "town/links.csv");
  for (const char* end : {"rsu,", "/roof", "/cab", "/deck"}) CHECK(contains(links, end));
}
