// SPDX-License-Identifier: Apache-2.0
// Maps, sections and the files of all figures, of invented runs without a device, whose numbers are known. Pictures
// need gnuplot; without it the tests of files say so and check the rest.
#include "plots/plots.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "coverage/coverage_map.hpp"
#include "plots/coverage_plot.hpp"
#include "plots/gnuplot.hpp"
#include "plotted_runs.hpp"
#include "reference/quads.hpp"
#include "results/link_rows.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::plots;
using namespace wavetracer::test;
namespace fs = std::filesystem;

TEST_CASE("coverage draws the best transmitter of each cell, or the one that is named, from dark and weak to bright") {
  const Written written = grid_run();
  const SavedRun run = written.run();
  const SavedFrame frame = run.frame(0);
  ReceiverGridConfig grid;
  grid.name = "g";
  const auto figure = [&](std::optional<uint32_t> tx, const std::string& layer) {
    const coverage::Map map = coverage::coverage_map(
        run, {}, frame, link_rows(frame, link_table(run), run.first_link(0), run.frequency_hz()), grid, {tx, {}});
    return coverage_figure(run, frame, "coverage", map, shown_layer(layer, {}), {}, {});
  };
  const Figure best = figure({}, ""), server = figure({}, "best_server");
  const std::vector<Row> rows = table(best.data[0].text), second = table(figure(1, "").data[0].text);
  REQUIRE(rows.size() == 6);
  for (uint32_t cell = 0; cell < 6; ++cell) {
    CHECK(number(rows[cell], "ix") == cell % 3);
    CHECK(number(rows[cell], "y_m") == 2.5 + 5.0 * (cell / 3));
  }
  for (uint32_t cell = 0; cell < 4; ++cell) {
    CHECK(number(rows[cell], "path_gain_db") == doctest::Approx(-10.0 * (cell + 8)).epsilon(1e-12));
    CHECK(rows[cell].at("tx") == run.transmitters()[0].name);
  }
  CHECK(number(rows[3], "paths") == 2);
  CHECK(number(rows[4], "path_gain_db") == doctest::Approx(-130).epsilon(1e-12));
  CHECK(rows[4].at("tx") == run.transmitters()[1].name);
  CHECK(std::isnan(number(rows[5], "path_gain_db")));
  CHECK(rows[5].at("tx").empty());
  CHECK(std::isnan(number(second[0], "path_gain_db")));
  CHECK(number(second[3], "path_gain_db") == doctest::Approx(-120).epsilon(1e-12));
  check_contains(best.commands, "set palette negative\nset cbrange [-130:-80]");
  check_contains(best.commands, "using 3:4:($6 > ");
  check_contains(best.commands, "title 'no value, as where no path leads'");
  check_contains(server.commands,
                 fmt::format("('{}' 0, '{}' 1)", run.transmitters()[0].name, run.transmitters()[1].name));
  check_contains(server.commands, "set palette defined (0 '#0072b2', 1 '#0072b2', 1 '#e69f00', 2 '#e69f00')");
  check_contains(server.commands, "using 3:4:($8 > ");
}

TEST_CASE("the section of a box is its outline, cut at the height") {
  Scene scene = reference::scene_of_quads(reference::box_walls({0, 0, 0}, {4, 3, 10}));
  scene.origin_m = {100, 200, 300};
  double length_m = 0;
  for (const auto& [x0, y0, x1, y1] : section(scene, 302.5)) {
    length_m += std::hypot(x1 - x0, y1 - y0);
    const auto on_border = [](double x, double y) {
      return std::min({std::abs(x - 100), std::abs(x - 104), std::abs(y - 200), std::abs(y - 203)}) < 1e-12;
    };
    CHECK(on_border(x0, y0));
    CHECK(on_border(x1, y1));
  }
  CHECK(length_m == doctest::Approx(14).epsilon(1e-12));
  CHECK(section(scene, 311).empty());
}

TEST_CASE("the section of a box by a vertical plane is a rectangle of the plane") {
  Scene scene = reference::scene_of_quads(reference::box_walls({0, 0, 0}, {4, 3, 10}));
  scene.origin_m = {100, 200, 300};
  coverage::VerticalPlane plane;  // it crosses the box from the corner at 100, 200 to that at 104, 203, 5 m away
  plane.from_m = {99.2, 199.4};
  plane.direction = {0.8, 0.6};
  double upright_m = 0, level_m = 0;
  for (const auto& [along0, z0, along1, z1] : section(scene, plane)) {
    const double along[] = {along0, along1}, z[] = {z0, z1};
    for (int k = 0; k < 2; ++k) {
      CHECK(std::min(std::abs(along[k] - 1), std::abs(along[k] - 6)) < 1e-9);
      CHECK(z[k] >= 300 - 1e-9);
      CHECK(z[k] <= 310 + 1e-9);
    }
    const bool level = std::abs(z0 - z1) < 1e-9;  // then it is a part of the roof or of the floor
    CHECK((level ? std::min(std::abs(z0 - 300), std::abs(z0 - 310)) : std::abs(along0 - along1)) < 1e-9);
    upright_m += std::abs(z0 - z1);
    level_m += level ? std::abs(along0 - along1) : 0;
  }
  CHECK(upright_m == doctest::Approx(20).epsilon(1e-9));
  CHECK(level_m == doctest::Approx(10).epsilon(1e-9));
  plane.from_m = {110, 190};
  CHECK(section(scene, plane).empty());
}

TEST_CASE("all figures that suit a run are written, each with its data and script") {
  const Written drive(SampleRun().drive(0, 12)), grid = grid_run();
  TemporaryFolder out;
  const auto has = [&](const std::string& name) { return fs::exists(out.path() / "a" / name); };
  const PlotReport report = plot_run(drive.run(), {}, out.path() / "a");
  for (const char* name : {"gain", "pdp", "delay-time", "doppler", "angles"}) {
    CAPTURE(name);
    CHECK(has(std::string(name) + ".csv"));
    CHECK(has(std::string(name) + ".gp"));
  }
  CHECK_FALSE(has("coverage.csv"));
  if (std::system("command -v gnuplot > /dev/null") != 0) {
    MESSAGE("no gnuplot: pictures are not checked");
    return;
  }
  REQUIRE_FALSE(report.files.empty());
  for (const char* name : {"gain.svg", "pdp.svg", "delay-time.svg", "doppler.svg", "angles.svg"}) CHECK(has(name));
  PlotChoice pdf;
  pdf.formats = {Format::pdf, Format::png};
  const PlotReport covered = plot_run(grid.run(), pdf, out.path() / "a");
  for (const std::string& warning : covered.warnings) MESSAGE(warning);
  CHECK(has("coverage.pdf"));
  CHECK(has("coverage.png"));
  for (const auto& entry : fs::directory_iterator(out.path() / "a"))  // scripts of further formats are gone
    CHECK_FALSE(entry.path().filename().string().starts_with("."));
  CHECK(table([&] {
          std::ostringstream text;
          text << std::ifstream(out.path() / "a" / "coverage.csv").rdbuf();
          return text.str();
        }())
            .size() == 6);
}

TEST_CASE("a logarithmic axis of less than two decades has several labels, and a long one those of decades") {
  if (std::system("command -v gnuplot > /dev/null") != 0) return;
  TemporaryFolder out;
  const auto labels = [&](const std::string& high) {
    Figure figure{.name = "axis", .title = "", .data = {{"axis.csv", "x\n3\n"}}, .commands = "", .width_px = 400};
    figure.commands = "set logscale x\nset format x '%g'\nset key off\nset ytics ('' 0)\nset xrange [2:" + high +
                      "]\n" + log_tics("x", "2", high) + "plot x\n";
    const Drawn drawn = draw(figure, Format::svg, out.path());
    REQUIRE(drawn.problem.empty());
    std::ostringstream svg;
    svg << std::ifstream(drawn.files.back()).rdbuf();
    const std::string text = svg.str();
    std::vector<std::string> found;
    for (size_t at = text.find("<tspan"); at != text.npos; at = text.find("<tspan", at + 1)) {
      const size_t begin = text.find('>', at) + 1;
      found.push_back(text.substr(begin, text.find('<', begin) - begin));
    }
    std::erase_if(found, [](const std::string& one) { return one.find_first_of("0123456789") == one.npos; });
    return found;
  };
  CHECK(labels("9").size() == 2);  // 2 and 5
  CHECK(labels("60").size() == 5);
  CHECK(labels("5000").size() == 3);
}

TEST_CASE("without gnuplot data and scripts are written, and one line says what to do") {
  const Written written(SampleRun().drive(0, 12));
  TemporaryFolder out;
  const std::string path = std::getenv("PATH");
  setenv("PATH", out.path().c_str(), 1);
  const PlotReport report =
      plot_run(written.run(), {.what = {"gain"}, .link = {}, .grid = {}, .layer = {}}, out.path() / "p");
  setenv("PATH", path.c_str(), 1);
  REQUIRE_FALSE(report.warnings.empty());
  check_contains(report.warnings.back(), "gain: gnuplot is not installed");
  check_contains(report.warnings.back(), "apt-get install gnuplot-nox");
  CHECK(fs::exists(out.path() / "p" / "gain.csv"));
  CHECK(fs::exists(out.path() / "p" / "gain.gp"));
  CHECK_FALSE(fs::exists(out.path() / "p" / "gain.svg"));
}

TEST_CASE("what the run does not have is an error that names what it has") {
  const Written drive(SampleRun().drive(0, 12)), still(SampleRun().empty()), grid = grid_run();
  TemporaryFolder out;
  const auto refused = [&](const Written& written, const PlotChoice& choice) {
    return error_of<Error>([&] { plot_run(written.run(), choice, out.path() / "x"); });
  };
  PlotChoice choice;
  choice.link.tx = "rsv";
  check_contains(refused(drive, choice),
                 "--tx \"rsv\" is not the name of a transmitter of the run; the nearest are \"rsu\"");
  choice.link = {.tx = {}, .rx = "cat", .frame = {}};
  check_contains(refused(drive, choice),
                 "--rx \"cat\" is not the name of a receiver of the run; the nearest are \"car\"");
  choice.link = {.tx = {}, .rx = {}, .frame = 99};
  check_contains(refused(drive, choice), "--frame 99: the run has frames 0 to 11");
  choice.link = {};
  choice.grid = "map";
  check_contains(refused(drive, choice), "--grid: the run has no [[receiver_grid]], so no map is drawn; leave it out");
  check_contains(refused(grid, choice),
                 "--grid \"map\" is not the name of a [[receiver_grid]] of the run, which has g");
  choice.grid.clear();
  choice.what = {"gian"};
  check_contains(
      refused(drive, choice),
      "--what \"gian\" is no plot, there are gain, pdp, delay-time, doppler, angles, coverage, rays, range-doppler, "
      "micro-doppler; "
      "did you mean \"gain\"?");
  choice.what = {"coverage"};
  check_contains(refused(drive, choice), "--what coverage: the run has no [[receiver_grid]]");
  choice.layer = "sinr_db";
  check_contains(refused(grid, choice), "--layer sinr_db needs radio.transmit_power_dbm and radio.bandwidth_hz, which");
  choice.layer = "tx_beam";
  check_contains(refused(grid, choice), "--layer tx_beam needs the links.csv of a run where a transmitter or the grid");
  choice.layer = "sinr";
  check_contains(refused(grid, choice), "\"sinr\" is no layer of a map, there are path_gain_db");
  choice.layer.clear();
  choice.what = {"rays"};
  check_contains(refused(drive, choice), "--what rays: the run has no waypoints.h5: give output.waypoints");
  choice.what = {"gain"};
  check_contains(refused(grid, choice), "only receivers of grids have paths");
  choice.link.rx = "g/0,0";
  check_contains(refused(grid, choice), "--what gain: the run has one frame only");
  check_contains(refused(still, {}), "the run found no path at all, so there is nothing to plot");
  CHECK(fs::is_empty(out.path()));
}

TEST_CASE("quotes and control characters in names cannot break a script") {
  CHECK(quoted("a'b\nset output\t'c'") == "a''b set output ''c''");
}
