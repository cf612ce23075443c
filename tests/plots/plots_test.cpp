// SPDX-License-Identifier: Apache-2.0
// The contents of plots are compared with the run that was written: invented runs without a device, whose numbers are
// known. Pictures need gnuplot; without it the tests of files say so and check the rest.
#include "plots/plots.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "coverage/coverage_map.hpp"
#include "output/sample_run.hpp"
#include "plots/coverage_plot.hpp"
#include "plots/gnuplot.hpp"
#include "plots/link_plots.hpp"
#include "reference/quads.hpp"
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::plots;
using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

std::vector<Row> table(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = fields(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = fields(line);
    REQUIRE(values.size() == header.size());
    Row& row = rows.emplace_back();
    for (size_t i = 0; i < header.size(); ++i) row[header[i]] = values[i];
  }
  return rows;
}

double number(const Row& row, const std::string& column) { return std::strtod(row.at(column).c_str(), nullptr); }

template <class E>
std::string error_of(const auto& action) {
  try {
    action();
  } catch (const E& e) {
    return e.what();
  }
  return "no error";
}

void check_contains(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CHECK(text.find(part) != text.npos);
}

// Written as a run writes it, in a folder of its own.
struct Written {
  SampleRun sample;
  TemporaryFolder folder;
  std::vector<FrameResult> frames;
  explicit Written(std::vector<FrameResult> of) : frames(std::move(of)) { write(); }
  Written(SampleRun run, std::vector<FrameResult> of) : sample(std::move(run)), frames(std::move(of)) { write(); }
  void write() { write_outputs(folder.path() / "run", sample.run(), frames); }
  SavedRun run() const { return SavedRun(folder.path() / "run"); }
};

double power_db(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return 10 * std::log10(power);
}

// A grid "g" of 3 x 2 behind a receiver of its own; transmitter 0 reaches cells 0 to 3, transmitter 1 cells 3 and 4,
// and none reaches cell 5. Powers are 10^-(tx + cell + 8).
Written grid_run() {
  SampleRun sample;
  sample.config.text =
      "scene.generate = \"--seed 1 --blocks 1x1\"\n"
      "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 9]\n[[receiver]]\nname = \"r\"\nposition_m = [1, 1, 1]\n"
      "[[receiver_grid]]\nname = \"g\"\nx_min_m = 0\nx_max_m = 15\ny_min_m = 0\ny_max_m = 10\nstep_m = 5\n";
  sample.config.receivers = {{.name = "r"}};
  for (int cell = 0; cell < 6; ++cell)
    sample.config.receivers.push_back({.name = fmt::format("g/{},{}", cell % 3, cell / 3),
                                       .position_m = {2.5 + 5.0 * (cell % 3), 2.5 + 5.0 * (cell / 3), 1.5}});
  FrameResult frame = sample.empty().front();
  frame.world.links.clear();
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t rx = 0; rx < 7; ++rx) frame.world.links.push_back({tx, rx});
  Paths& p = frame.paths;
  const auto add = [&](uint32_t tx, uint32_t rx, double amplitude) {
    p.frame.push_back(0);
    p.tx.push_back(tx);
    p.rx.push_back(rx);
    p.depth.push_back(0);
    p.delay_s.push_back(1e-7);
    p.gain_db.push_back(20 * std::log10(amplitude));
    p.a.push_back({{{amplitude, 0}, {0, 0}, {0, 0}, {0, 0}}});
    for (auto* column : {&p.aod_theta_rad, &p.aod_phi_rad, &p.aoa_theta_rad, &p.aoa_phi_rad, &p.doppler_hz})
      column->push_back(0);
    p.vertex_offset.push_back(0);
  };
  const auto amplitude = [](uint32_t tx, uint32_t cell) { return std::pow(10, -0.5 * (tx + cell + 8.0)); };
  for (uint32_t cell = 0; cell < 4; ++cell)
    for (int half = 0; half < 2; ++half) add(0, cell + 1, amplitude(0, cell) * std::sqrt(0.5));  // two paths a cell
  for (uint32_t cell = 3; cell < 5; ++cell) add(1, cell + 1, amplitude(1, cell));
  return Written(std::move(sample), {frame});
}

}  // namespace

TEST_CASE("the series of a named link holds its paths, frame by frame") {
  const Written written(SampleRun().drive(0, 12));
  const SavedRun run = written.run();
  const LinkSeries series = link_series(run, {.tx = "rsu", .rx = "car", .frame = {}}, {}, 6);
  REQUIRE(series.links.size() == 1);
  REQUIRE(series.moments[0].size() == 12);
  size_t next = 0;
  for (uint32_t frame = 0; frame < 12; ++frame) {
    CHECK(series.moments[0][frame].time_s == 0.1 * frame);
    const uint32_t paths = frame % 5 == 4 ? 0 : (frame * 7 + 3) % 4;
    CHECK(series.moments[0][frame].figures.paths == paths);
    for (uint32_t i = 0; i < paths; ++i, ++next) {
      CHECK(series.paths[next].frame == frame);
      CHECK(series.paths[next].delay_s == 1e-7 * (i + 1));
      CHECK(series.paths[next].gain_db == -80.0 - i);
      CHECK(series.paths[next].doppler_hz == 10.0 * i);
    }
  }
  CHECK(series.paths.size() == next);
}

TEST_CASE("the axis of times counts from the first one where labels could not tell times apart") {
  const Written written(SampleRun().drive(0, 12));
  const SavedRun run = written.run();
  LinkSeries series = link_series(run, {}, {}, 6);
  const auto commands_of = [&](double zero_s) {
    for (auto& moments : series.moments)
      for (size_t k = 0; k < moments.size(); ++k) moments[k].time_s = zero_s + 0.1 * static_cast<double>(k);
    return gain_figure(run, series, {}).commands + delay_time_figure(run, series).commands;
  };
  check_contains(commands_of(0), "set xlabel 'time (s)'");
  check_contains(commands_of(0), "using ($1 == 1 ? $5 : NaN):7");
  check_contains(commands_of(1.7e9), "set xlabel 'time after 1700000000 s (s)'");
  check_contains(commands_of(1.7e9), "using ($1 == 1 ? ($5 - 1700000000) : NaN):7");
  check_contains(commands_of(1.7e9), "using (($1 - 1700000000)):(1e9 * $2):3 with image");
}

TEST_CASE("the table of the gain figure is the run's, with nothing where there is no path") {
  const Written written(SampleRun().drive(0, 12));
  const SavedRun run = written.run();
  const LinkSeries series = link_series(run, {}, {}, 6);
  REQUIRE(series.links.size() == 2);
  const std::vector<Row> rows = table(gain_figure(run, series, {}).data[0].text);
  REQUIRE(rows.size() == 24);
  for (const Row& row : rows) {
    const auto frame = static_cast<size_t>(number(row, "frame"));
    const uint32_t tx = row.at("tx") == "rsu" ? 1 : 0;
    const Paths& paths = written.frames[frame].paths;
    double power = 0;
    for (size_t i = 0; i < paths.size(); ++i)
      if (paths.tx[i] == tx && paths.rx[i] == 0) power += std::pow(10, power_db(paths, i) / 10);
    CHECK(row.at("rx") == "car");
    if (power > 0)
      CHECK(number(row, "path_gain_db") == doctest::Approx(10 * std::log10(power)).epsilon(1e-12));
    else
      CHECK(std::isnan(number(row, "path_gain_db")));
  }
}

TEST_CASE("figures of one frame list its paths with angles in degrees, weakest first") {
  const Written written(SampleRun().frames());
  const SavedRun run = written.run();
  const LinkSeries series = link_series(run, {.tx = "rsu", .rx = "car", .frame = 7}, {}, 6);
  const std::vector<Row> rows = table(angle_figure(run, series).data[0].text);
  REQUIRE(rows.size() == 1);  // path 2 of the sample
  CHECK(number(rows[0], "delay_s") == 1e-7 * 3);
  CHECK(number(rows[0], "departure_azimuth_deg") == doctest::Approx(0.4 * 180 / M_PI));
  CHECK(number(rows[0], "departure_elevation_deg") == doctest::Approx(90 - 0.2 * 180 / M_PI));
  CHECK(number(rows[0], "arrival_azimuth_deg") == doctest::Approx(-0.8 * 180 / M_PI));
  CHECK(rows[0].at("kind_name") == "transmitted");
}

TEST_CASE("axes of delays do not go below zero, however near the first path is") {
  SampleRun sample;
  std::vector<FrameResult> frames = sample.frames();
  for (FrameResult& frame : frames)
    for (double& delay_s : frame.paths.delay_s) delay_s *= 1e-3;  // fractions of a nanosecond
  const Written written(std::move(sample), frames);
  const SavedRun run = written.run();
  const LinkSeries series = link_series(run, {.tx = "rsu", .rx = "car", .frame = 7}, {}, 6);
  for (const Figure& figure : {delay_figure(run, series), doppler_figure(run, series)}) {
    CAPTURE(figure.commands);
    const size_t at = figure.commands.find("set xrange [");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(figure.commands.substr(at + 12)) == 0);
    CHECK(figure.commands.find("offsets graph 0.0") == std::string::npos);
  }
  CHECK(delay_time_figure(run, series).commands.find("set yrange [0<*:]") != std::string::npos);
}

TEST_CASE("cells of the delay-time image add up to the power of all paths") {
  const Written written(SampleRun().drive(0, 12));
  const SavedRun run = written.run();
  const LinkSeries series = link_series(run, {.tx = "rsu", .rx = "car", .frame = {}}, {}, 6);
  double cells = 0, paths = 0;
  for (const Row& row : table(delay_time_figure(run, series).data[0].text))
    if (const double gain = number(row, "gain_db"); !std::isnan(gain)) cells += std::pow(10, gain / 10);
  for (const PathPoint& p : series.paths) paths += std::pow(10, p.gain_db / 10);
  CHECK(cells == doctest::Approx(paths).epsilon(1e-12));
}

TEST_CASE("beams have colours of their own, and at most twenty of them are named") {
  const Written written = grid_run();
  const SavedRun run = written.run();
  const SavedFrame frame = run.frame(0);
  ReceiverGridConfig grid;
  grid.name = "g";
  std::vector<LinkRow> links = link_rows(frame, link_table(run), run.first_link(0), run.frequency_hz());
  for (LinkRow& link : links) {
    link.beam_gain_db = -80;
    link.tx_beam = 41;
    link.rx_beam = 0;
  }
  const coverage::Map map = coverage::coverage_map(run, {}, frame, links, grid, {});
  const auto commands = [&](const char* layer) {
    return coverage_figure(run, frame, "coverage", map, shown_layer(layer, {}), {}, {}).commands;
  };
  check_contains(commands("tx_beam"), "set cbrange [-0.5:41.5]\nset cbtics noenhanced ('0' 0, '3' 3, '6' 6, ");
  check_contains(commands("tx_beam"), ", 41 '#d55e00', 42 '#d55e00')");
  check_contains(commands("rx_beam"), "set palette defined (0 '#0072b2', 1 '#0072b2')\nset cbrange [-0.5:0.5]");
}

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
  pdf.format = Format::pdf;
  const PlotReport covered = plot_run(grid.run(), pdf, out.path() / "a");
  for (const std::string& warning : covered.warnings) MESSAGE(warning);
  CHECK(has("coverage.pdf"));
  CHECK(table([&] {
          std::ostringstream text;
          text << std::ifstream(out.path() / "a" / "coverage.csv").rdbuf();
          return text.str();
        }())
            .size() == 6);
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
  check_contains(refused(drive, choice),
                 "--grid \"map\" is not the name of a [[receiver_grid]] of the run, which has none");
  check_contains(refused(grid, choice), "which has g");
  choice.grid.clear();
  choice.what = {"gian"};
  check_contains(refused(drive, choice),
                 "--what \"gian\" is no plot, there are gain, pdp, delay-time, doppler, angles, coverage, rays; "
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
