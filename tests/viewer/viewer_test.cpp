// SPDX-License-Identifier: Apache-2.0
// Tests pages without a browser: their parts, limits and errors; writes the pages that the tests in a browser open.
// Pages are in BUILD/tests/viewer/NAME/view.html beside the paths.h5 that they show.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include "base/digits.hpp"
#include "base/file.hpp"
#include "output/sample_run.hpp"
#include "radio/links.hpp"
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "viewer/blocks.hpp"
#include "viewer/grid_maps.hpp"
#include "viewer/made_runs.hpp"
#include "viewer/page_files.hpp"
#include "viewer/pages.hpp"
#include "viewer/scene_blocks.hpp"
#include "viewer/strongest.hpp"
#include "viewer/view.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
namespace fs = std::filesystem;

namespace {

size_t count_of(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

}  // namespace

TEST_CASE("a street keeps its width along its line and around a corner, and has no spikes") {
  using Points = std::vector<glm::dvec3>;
  CHECK(street_rims({{{0, 0, 1}, {0, 0, 1}, {10, 0, 2}}, 4}) == Points{{0, 2, 1}, {0, -2, 1}, {10, 2, 2}, {10, -2, 2}});
  const Points corner = street_rims({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, 4});
  REQUIRE(corner.size() == 6);
  CHECK(glm::distance(corner[2], {8, 2, 0}) < 1e-12);
  CHECK(glm::distance(corner[3], {12, -2, 0}) < 1e-12);
  for (const double back_m : {1e-3, 0.0}) {
    for (const glm::dvec3& p : street_rims({{{0, 0, 0}, {10, 0, 0}, {0, back_m, 0}}, 4})) {
      CHECK(std::isfinite(p.x + p.y));
      CHECK(p.x <= 14);  // twice half of the width beyond the end
    }
  }
  CHECK(street_rims({{{1, 1, 0}, {1, 1, 5}}, 4}).empty());
}

TEST_CASE("streets that are nowhere near the scene are left out, and those that are too many are counted") {
  Scene scene;
  scene.origin_m = {1000, 0, 0};
  scene.vertices = {{-50, -50, 0}, {50, 50, 0}};
  const Street near{{{1000, 0, 0}, {1020, 0, 0}}, 3}, far{{{0, 0, 0}, {20, 0, 0}}, 3};
  std::string both, one;
  CHECK(add_street_blocks(std::vector<Street>{near, far}, scene, scene.origin_m, both).empty());
  CHECK(add_street_blocks(std::vector<Street>{near}, scene, scene.origin_m, one).empty());
  CHECK(both == one);
  CHECK(count_of(one, "street_vertices") == 1);
  CHECK(add_street_blocks(std::vector<Street>(250'003, near), scene, scene.origin_m, both) ==
        "the page leaves out 3 lanes of the road network, as it holds 500,000 points of them at most");
}

TEST_CASE("base64 of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xFF\xFB") == "//s=");
}

TEST_CASE("no text can end its script element") {
  CHECK(script_text("[\"</script><b>\"]") == "[\"\\u003c/script>\\u003cb>\"]");
  for (const char* name : {"three.min.js", "main.js", "data.js", "details.js", "style.css"})
    CHECK(page_file(name).find("</s") == std::string_view::npos);
  CHECK_THROWS_AS(page_file("none.js"), RuntimeError);
}

TEST_CASE("values that 16 bits cannot hold are clamped") {
  Packer packer;
  for (const double value : {0.0, 1.0, -1.0, 7.0, std::numeric_limits<double>::quiet_NaN()}) packer.add_share(value, 2);
  const auto* words = reinterpret_cast<const int16_t*>(packer.bytes().data());
  CHECK(words[0] == 0);
  CHECK(words[1] == 16384);
  CHECK(words[2] == -16384);
  CHECK(words[3] == 32767);
  CHECK(words[4] == 0);
}

TEST_CASE("the strongest rows, by count and by bytes") {
  const double gains[] = {-90, -70, std::numeric_limits<double>::quiet_NaN(), -80, -80,
                          500, -60, -std::numeric_limits<double>::infinity()};
  const auto kept = [&](uint64_t rows, uint64_t bytes) {
    Strongest strongest;
    for (const double gain : gains) strongest.count(gain, 10);
    strongest.limit(rows, bytes);
    std::string out;
    for (const double gain : gains) out += strongest.keep(gain, 10) ? 'x' : '.';
    return out;
  };
  CHECK(kept(100, 1000) == "xxxxxxxx");
  CHECK(kept(1, 1000) == ".....x..");
  CHECK(kept(4, 1000) == ".x.x.xx.");  // the first of the equal ones
  CHECK(kept(100, 50) == ".x.xxxx.");
  CHECK(kept(100, 69) == "xx.xxxx.");
  CHECK(kept(7, 1000) == "xxxxxxx.");  // none has power: kept in their order
  CHECK(kept(0, 1000) == "........");
}

TEST_CASE("a drive in a city") {
  test::write_made_run({}, folder / "drive");
  const ViewPage page = write_page("drive");
  CHECK(page.paths == 11 * 4 * 6);
  CHECK(page.frames == 11);
  CHECK(page.warnings.empty());
  const nlohmann::json meta = meta_of(page);
  CHECK(meta["title"] == "drive");
  CHECK(meta["instances"][1] == nlohmann::json{"veh1", "passenger", 0});
  CHECK(meta["scene"]["materials"].size() > 1);
  CHECK(meta["frames"][3][2] == 24);
  CHECK(count_of(page.html, "id=\"block_frame_") == 11);
  CHECK(count_of(page.html, "http-equiv=\"Content-Security-Policy\"") == 1);

  SUBCASE("less of it, and said so") {
    const ViewPage part = make_view(SavedRun(folder / "drive"), {2, 4, 10, "a <title>", page_bytes});
    CHECK(part.frames == 3);
    CHECK(part.paths == 10);
    REQUIRE(part.warnings.size() == 1);
    CHECK(part.warnings[0].find("10 strongest of 72 paths") != std::string::npos);
    CHECK(meta_of(part)["title"] == "a <title>");
    CHECK(meta_of(part)["frames"][0][0] == 2);
  }
  SUBCASE("frames that there are not") {
    CHECK_THROWS_WITH_AS(make_view(SavedRun(folder / "drive"), {.first_frame = 40, .last_frame = 50}),
                         doctest::Contains("its frames are 0 to 10"), ConfigError);
  }
}

TEST_CASE("what is no whole grid is none") {
  const auto grids = [](std::initializer_list<const char*> names) {
    std::vector<RadioEnd> ends;
    for (const char* name : names) ends.push_back({.name = name});
    std::string out;
    for (const GridMap& grid : find_grids(ends))
      out += fmt::format("{} {} {}x{};", grid.name, grid.first, grid.columns, grid.rows);
    return out;
  };
  CHECK(grids({"g/0,0", "g/1,0", "g/0,1", "g/1,1"}) == "g 0 2x2;");
  CHECK(grids({"car", "g/0,0", "g/0,1", "g/0,2", "g/0,3", "bus"}) == "g 1 1x4;");
  CHECK(grids({"a/0,0", "a/1,0", "a/2,0", "a/3,0", "b/0,0", "b/1,0", "b/2,0", "b/3,0"}) == "a 0 4x1;b 4 4x1;");
  CHECK(grids({"g/0,0", "g/1,0", "g/0,1"}) == "");           // the last row is not whole
  CHECK(grids({"g/0,0", "g/1,0", "g/1,1", "g/0,1"}) == "");  // not row by row
  CHECK(grids({"g/1,0", "g/2,0", "/0,0", "g/0,0"}) == "");
  CHECK(grids({}) == "");
}

TEST_CASE("figures of links are those of links.csv") {
  const SavedRun run(folder / "drive");
  const SavedFrame frame = run.frame(3);
  const LinkTable table = link_table(run);
  const std::vector<LinkRow> rows = link_rows(frame, table, run.first_link(3), 5.9e9);
  const std::vector<LinkRow> of_paths = link_rows(frame, {}, run.first_link(3), 5.9e9);
  const std::vector<LinkFigures> figures = link_figures(frame.paths, frame.number, frame.links, 5.9e9);
  REQUIRE(rows.size() == figures.size());
  REQUIRE(of_paths.size() == figures.size());
  for (size_t k = 0; k < rows.size(); ++k) {
    for (const LinkRow& row : {rows[k], of_paths[k]}) {
      CHECK(row.paths == figures[k].paths);
      CHECK(row.los == figures[k].los);
      CHECK(row.path_gain_db == doctest::Approx(figures[k].path_gain_db));
      CHECK(row.narrowband_gain_db == doctest::Approx(figures[k].narrowband_gain_db));
      CHECK(row.rms_delay_spread_s == doctest::Approx(figures[k].rms_delay_spread_s));
    }
    CHECK(rows[k].missed_power_share > 0);
    CHECK(std::isnan(of_paths[k].missed_power_share));
  }
  // Rows that are not sorted, and a path of a link that was not asked for.
  SavedFrame other = run.frame(3);
  std::reverse(other.links.begin(), other.links.end());
  other.links.pop_back();
  const std::vector<LinkRow> again = link_rows(other, {}, 0, 5.9e9);
  REQUIRE(again.size() == rows.size());
  for (size_t k = 0; k < rows.size(); ++k) CHECK(again[k].path_gain_db == of_paths[k].path_gain_db);
}

TEST_CASE("figures of links count the paths that output limits have left out") {
  SavedFrame frame = SavedRun(folder / "drive").frame(3);
  LinkTable table;
  for (size_t k = 0; k < frame.links.size(); ++k) {
    table.paths.push_back(100.0 + static_cast<double>(k));
    table.path_gain_db.push_back(-50.0 - static_cast<double>(k));
    table.los.push_back(1);
  }
  const std::vector<LinkRow> rows = link_rows(frame, table, 0, 5.9e9);
  for (size_t k = 0; k < rows.size(); ++k) {
    CHECK(rows[k].paths == 100 + k);
    CHECK(rows[k].path_gain_db == -50.0 - static_cast<double>(k));
    CHECK(rows[k].los);
    CHECK(std::isfinite(rows[k].rms_delay_spread_s));  // computed from the paths, as the table does not have it
  }
}

TEST_CASE("capped, hostile, without a scene: the pages of the browser") {
  test::write_made_run({}, folder / "capped");
  CHECK(write_page("capped", {.max_paths = 50}).paths == 50);

  const std::string attack = "</script><img src=x onerror=\"window.hacked=1\"> \"'&\xC3\xBC\xE6\x9D\xB1\xFF ";
  test::write_made_run({.frames = 2, .prefix = attack}, folder / "hostile");
  const ViewPage hostile = write_page("hostile", {.title = attack});
  CHECK(hostile.html.find("<img") == std::string::npos);
  CHECK(std::all_of(hostile.html.begin(), hostile.html.end(), [](char c) { return static_cast<signed char>(c) > 0; }));

  test::write_made_run({.frames = 2, .scene = "file = \"/nowhere/gone.xml\""}, folder / "missing");
  const ViewPage missing = write_page("missing");
  REQUIRE(missing.warnings.size() == 1);
  CHECK(missing.warnings[0].find("/nowhere/gone.xml") != std::string::npos);
  CHECK(missing.paths == 48);
}

TEST_CASE("no paths, one frame, thousands of frames") {
  const SampleRun sample;
  write_outputs(folder / "empty", sample.run(), sample.empty());
  CHECK(write_page("empty").paths == 0);
  const auto frames = sample.frames();
  write_outputs(folder / "single", sample.run(), Frames(frames).first(1));
  CHECK(write_page("single").paths == 3);
  write_outputs(folder / "long", sample.run(), sample.drive(0, 3000));
  const ViewPage page = write_page("long");
  CHECK(page.frames == 3000);
  CHECK(page.html.size() < 10e6);
}

TEST_CASE("a hundred vehicles, a hundred thousand paths per frame") {
  test::write_made_run({.vehicles = 100, .frames = 2, .paths_a_link = 10}, folder / "large");
  const ViewPage page = write_page("large");
  CHECK(page.paths == 200000);
  CHECK(page.html.size() < page_bytes);
  MESSAGE(
      fmt::format("page of 2 x 100000 paths and 100 vehicles: {:.1f} MB", static_cast<double>(page.html.size()) / 1e6));

  // Paths that do not fit are left out, the weakest first, and the page says so.
  const ViewPage small = make_view(SavedRun(folder / "large"), {.max_bytes = 12'000'000});
  CHECK(small.html.size() < 12'000'000);
  CHECK(small.html.size() > 11'500'000);
  CHECK(small.paths < 200000);
  REQUIRE(small.warnings.size() == 1);
  CHECK(small.warnings[0].find(fmt::format("{} strongest of 200,000 paths", grouped(small.paths))) !=
        std::string::npos);
}
