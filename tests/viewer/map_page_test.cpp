// SPDX-License-Identifier: Apache-2.0
// Pages of runs with grids: what they hold of maps.
#include <doctest/doctest.h>
#include <vector>
#include "viewer/grid_maps.hpp"
#include "viewer/made_runs.hpp"
#include "viewer/pages.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("a map of receivers is one, and what it shows is what its paths say") {
  write_made_coverage({.columns = 300, .rows = 300}, folder / "coverage");
  const SavedRun run(folder / "coverage");
  const std::vector<GridMap> grids = find_grids(run.receivers());
  REQUIRE(grids.size() == 1);
  CHECK(grids[0].name == "map");
  CHECK(grids[0].first == 1);
  CHECK(grids[0].columns == 300);
  CHECK(grids[0].rows == 300);
  const ViewPage page = write_page("coverage");
  const nlohmann::json meta = meta_of(page);
  CHECK(meta["receivers"].size() == 1);
  CHECK(meta["grids"][0]["first_m"][1].get<double>() + meta["centre_m"][1].get<double>() == doctest::Approx(-149.5));
  CHECK(meta["grids"][0]["column_m"] == nlohmann::json{1, 0});
  CHECK(meta["grids"][0]["row_m"] == nlohmann::json{0, 1});
  CHECK(meta["grids"][0]["rise_m"] == 0);
  CHECK(meta["links"] == 2 * 90001);
  CHECK(page.html.size() < 40e6);
}

TEST_CASE("a map on a vertical plane has steps along it and upwards") {
  write_made_coverage({.columns = 12, .rows = 9, .upright = true}, folder / "upright");
  const nlohmann::json grid = meta_of(write_page("upright"))["grids"][0];
  CHECK(grid["column_m"][0].get<double>() == doctest::Approx(0.6));
  CHECK(grid["column_m"][1].get<double>() == doctest::Approx(0.8));
  CHECK(grid["row_m"] == nlohmann::json{0, 0});
  CHECK(grid["rise_m"].get<double>() == doctest::Approx(1));
  CHECK(grid["rows"] == 9);
}

TEST_CASE("links on the page have columns of beams and of the areas of cells where the run has them") {
  write_made_coverage({.columns = 30, .rows = 12, .frames = 4, .beams = true}, folder / "film");
  const auto columns = [](const ViewPage& page) { return meta_of(page)["link_columns"]; };
  CHECK(columns(write_page("film")) == nlohmann::json{{"areas", true}, {"beams", true}});
  write_made_run({.frames = 1}, folder / "bare");
  CHECK(columns(make_view(SavedRun(folder / "bare"), {})) == nlohmann::json{{"areas", false}, {"beams", false}});
  // A page that shows the newest frame of a live world is made while frames go on.
  CHECK(columns(make_view(SavedRun(folder / "film"), {.reload_s = 1})) ==
        nlohmann::json{{"areas", false}, {"beams", true}});
  // 4 frames, 2 transmitters, 10 columns of two paths and 10 of one, 12 rows.
  const ViewPage enough = make_view(SavedRun(folder / "film"), {.area_paths = 2880});
  CHECK(columns(enough)["areas"] == true);
  CHECK(enough.warnings.empty());
  const ViewPage many = make_view(SavedRun(folder / "film"), {.area_paths = 2879});
  CHECK(columns(many)["areas"] == false);
  REQUIRE(many.warnings.size() == 1);
  CHECK(many.warnings[0].starts_with("the map has no cell mean and no fading, which take long for 2880 paths"));
  write_made_coverage({.columns = 4, .rows = 2, .max_paths_per_link = 1}, folder / "limited");
  const ViewPage limited = make_view(SavedRun(folder / "limited"), {});
  CHECK(columns(limited)["areas"] == true);
  REQUIRE(limited.warnings.size() == 1);
  CHECK(limited.warnings[0].find("max_paths_per_link) have left out up to ") != std::string::npos);
}
