// SPDX-License-Identifier: Apache-2.0
// The tables of figures of links are compared with the run that was written: invented runs without a device, whose
// numbers are known.
#include "plots/link_plots.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "plots/plots.hpp"
#include "plotted_runs.hpp"
#include "results/link_rows.hpp"
#include "results/link_table.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::plots;
using namespace wavetracer::test;

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
