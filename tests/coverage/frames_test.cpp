// SPDX-License-Identifier: Apache-2.0
// Maps of several frames: their layers, their colours, and what the files of one frame share with those of all.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "coverage/made_grid.hpp"
#include "coverage/png.hpp"
#include "coverage/write_map.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;
using test::MadeGrid;
namespace fs = std::filesystem;

namespace {

ReceiverGridConfig grid_of_frames() {
  ReceiverGridConfig grid;
  grid.name = "g";
  return grid;
}

// Two frames of a row of cells: gains from -60 dB down in frame 9 at 1 s, and 40 dB less, with beams, in frame 10.
struct TwoFrames {
  MadeGrid weak{4, 1, {{0, 0, 20}}}, strong{4, 1, {{0, 0, 20}}};

  TwoFrames() {
    for (uint32_t cell = 0; cell < 4; ++cell) {
      strong.add(0, cell, std::pow(10, -3 - 0.25 * cell), 1e-7, 0);
      weak.add(0, cell, std::pow(10, -5 - 0.25 * cell), 1e-7, 0);
      weak.frame.beams.tx.push_back(0);
      weak.frame.beams.rx.push_back(cell + 1);
      weak.frame.beams.tx_beam.push_back(cell);
      weak.frame.beams.rx_beam.push_back(0);
      weak.frame.beams.gain_db.push_back(-90);
    }
    number(strong, 9, 1);
    number(weak, 10, 1.5);
  }
  static void number(MadeGrid& made, uint32_t frame, double time_s) {
    made.frame.frame = frame;
    made.frame.world.time_s = time_s;
    for (uint32_t& each : made.frame.paths.frame) each = frame;
  }
  SavedRun written() {
    const std::vector<FrameResult> frames = {strong.frame, weak.frame};
    write_outputs(strong.folder.path() / "run", strong.sample.run(), frames);
    return SavedRun(strong.folder.path() / "run");
  }
};

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("maps of several frames have the same layers, also where only one frame has beams") {
  TwoFrames two;
  const SavedRun run = two.written();
  const std::vector<Map> maps = coverage_maps(run, {}, 0, 1, link_table(run), grid_of_frames(), {});
  REQUIRE(maps.size() == 2);
  CHECK(maps[0].layers == maps[1].layers);
  CHECK(maps[0].layers.back() == &layer_kind("rx_beam"));
  CHECK(std::isnan(maps[0].cells[3].tx_beam));
  CHECK(maps[1].cells[3].tx_beam == 3);
  CHECK(maps[0].frame == 9);
  CHECK(maps[1].time_s == 1.5);
  const auto first = [&](const MapChoice& choice) {
    return coverage_maps(run, {}, 0, 0, link_table(run), grid_of_frames(), choice).front();
  };
  CHECK(first({}).layers.size() == maps[0].layers.size() - 3);
  CHECK_THROWS_WITH_AS(first({.layers = {"tx_beam"}}), doctest::Contains("--layers tx_beam needs the links.csv"),
                       ConfigError);
}

TEST_CASE("a colour is the same value in all frames, and files have the numbers of frames in their names") {
  TwoFrames two;
  const SavedRun run = two.written();
  const std::vector<Map> maps =
      coverage_maps(run, {}, 0, 1, link_table(run), grid_of_frames(), {.layers = {"path_gain_db"}});
  test::TemporaryFolder folder;
  const std::vector<fs::path> files =
      write_maps({maps, true, {"csv", "npy", "geotiff", "png"}}, folder.path() / "maps");
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  CHECK(names == std::vector<std::string>{"coverage.csv", "coverage.json", "path_gain_db.npy", "path_gain_db_09.pgw",
                                          "path_gain_db_09.png", "path_gain_db_09.tif", "path_gain_db_10.pgw",
                                          "path_gain_db_10.png", "path_gain_db_10.tif", "time_s.npy", "x_m.npy",
                                          "y_m.npy", "z_m.npy"});
  const nlohmann::json about = nlohmann::json::parse(text_of(folder.path() / "maps/coverage.json"));
  CHECK(about["frames"] == nlohmann::json::parse(R"([{"frame": 9, "time_s": 1.0}, {"frame": 10, "time_s": 1.5}])"));
  CHECK(about["layers"]["path_gain_db"]["dark_to_bright"] == nlohmann::json::parse("[-115.0, -60.0]"));
  for (const size_t k : {0, 1})
    CHECK(text_of(files[k == 0 ? 4 : 7]) ==
          png(maps[k], layer_kind("path_gain_db"), maps[k].values(layer_kind("path_gain_db")), {-115, -60}));
  const std::string table = text_of(folder.path() / "maps/coverage.csv");
  CHECK(table.starts_with("frame,time_s,ix,iy,x_m,y_m,z_m,path_gain_db,tx\n9,1,0,0,5,5,1.5,-60,t0\n"));
  CHECK(table.find("\n10,1.5,0,0,5,5,1.5,-100,t0\n") != std::string::npos);
  CHECK(std::ranges::count(table, '\n') == 1 + 8);
  CHECK(text_of(folder.path() / "maps/path_gain_db.npy").find("'shape': (2, 1, 4), }") != std::string::npos);
}
