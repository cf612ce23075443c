// SPDX-License-Identifier: Apache-2.0
// Tests experiments without a device: ray counts, series, configs, sums of stages, gains, table and script.
// Expected values are written out or computed another way.
#include <doctest/doctest.h>
#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include "folders.hpp"
#include "output/median.hpp"
#include "study/made_order_rows.hpp"
#include "study/occurrences.hpp"
#include "study/ray_counts.hpp"
#include "study/scripts.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace

TEST_CASE("ray counts are 1, 2 and 5 times powers of ten, and the thesis' 49,000 and 90,000,000") {
  CHECK(ray_counts({}) == std::vector<uint64_t>{1000, 2000, 5000, 10000, 20000, 49000, 50000, 100000, 200000, 500000,
                                                1000000, 2000000, 5000000, 10000000, 20000000, 50000000, 90000000});
  CHECK(ray_counts({80000000, 100000000}) == std::vector<uint64_t>{90000000, 100000000});
  CHECK(ray_counts({49000, 49000}) == std::vector<uint64_t>{49000});
  CHECK(ray_counts({1001, 5000}) == std::vector<uint64_t>{2000, 5000});
  CHECK(ray_counts({1000000000, 1000000000}) == std::vector<uint64_t>{1000000000});
  CHECK_THROWS_WITH_AS(ray_counts({3000, 4000}), doctest::Contains("no ray count of the figure lies in it"),
                       ConfigError);
}

TEST_CASE("ranges of ray counts") {
  const RayRange range = parse_ray_range("2000:1e5");
  CHECK(range.first == 2000);
  CHECK(range.last == 100000);
  for (const char* text : {"", "5", ":", "1000:", ":1000", "2000:1000", "999:2000", "1000:2e9", "1000:1500.5", "a:b",
                           "1000:2000x", "-1000:2000", "1000:nan", "1000:inf", "1000:2000:3000"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_ray_range(text), ConfigError);
  }
}

TEST_CASE("numbers are grouped by thousands") {
  CHECK(grouped(7) == "7");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(49000) == "49,000");
  CHECK(grouped(10000000) == "10,000,000");
}

TEST_CASE("figure-6.1 has every method of order.method and every launch shape") {
  const Experiment& experiment = find_experiment("figure-6.1");
  CHECK(experiment.as<OrderFigure>()->series.front() == unordered());
  std::set<std::string> methods, shapes, labels;
  for (const Series& series : experiment.as<OrderFigure>()->series) {
    methods.insert(series.method);
    shapes.insert(series.shape);
    labels.insert(label(series));
    CHECK(series.each_depth == (series.method == "direction-origin"));
    CHECK((has_bins(series) || series.bins == 16));
    // The field table must know its values.
    Config applied = load_config(test::source_folder() + "/configs/city.toml");
    apply(applied, series, 1000);
    CHECK(applied.order.bin_num == series.bins);
    CHECK_NOTHROW(parse_config(resolved_config(applied), "resolved.toml"));
  }
  CHECK(methods == std::set<std::string>{"none", "morton", "hilbert3d-histogram", "morton-histogram",
                                         "hilbert3d-histogram-hilbert2d", "hilbert3d-histogram-hilbert3d",
                                         "direction-origin"});
  CHECK(shapes == std::set<std::string>{"1d", "2d", "3d"});
  CHECK(labels == std::set<std::string>{"WS",
                                        "WS 2d",
                                        "WS 3d",
                                        "Z",
                                        "H3DH",
                                        "H3DH 2d",
                                        "H3DH 3d",
                                        "HZ",
                                        "H3DH2DH",
                                        "H3DH3DH",
                                        "direction-origin",
                                        "born ordered",
                                        "H3DH 32 bins",
                                        "HZ 32 bins",
                                        "H3DH2DH 32 bins",
                                        "H3DH3DH 32 bins",
                                        "H3DH 64 bins",
                                        "HZ 64 bins",
                                        "H3DH2DH 64 bins",
                                        "H3DH3DH 64 bins",
                                        "H3DH 128 bins",
                                        "HZ 128 bins",
                                        "H3DH2DH 128 bins",
                                        "H3DH3DH 128 bins"});
  CHECK(labels.size() == experiment.as<OrderFigure>()->series.size());
}

TEST_CASE("an unknown experiment is answered with the known ones and the nearest") {
  CHECK_THROWS_WITH_AS(find_experiment("figure-6.19"),
                       doctest::Contains("thesis: no experiment \"figure-6.19\" among figure-6.1, figure-6.2, "),
                       ConfigError);
  CHECK_THROWS_WITH_AS(find_experiment("coherence-ray"), doctest::Contains("did you mean \"coherence-rays\"?"),
                       ConfigError);
}

TEST_CASE("the built-in city is that of configs/city.toml") {
  const Config city = experiment_config(find_experiment("figure-6.1"), "", {});
  const Config demo = load_config(test::source_folder() + "/configs/city.toml");
  CHECK(city.scene.generate == demo.scene.generate);
  REQUIRE(city.transmitters.size() == 1);
  CHECK(city.transmitters[0].position_m == demo.transmitters.at(0).position_m);
  REQUIRE(city.receivers.size() == demo.receivers.size());
  for (size_t i = 0; i < demo.receivers.size(); ++i)
    CHECK(city.receivers[i].position_m == demo.receivers[i].position_m);
}

TEST_CASE("keys that a experiment varies cannot be set, others can") {
  const Experiment& still = find_experiment("figure-6.1");
  for (const char* set : {"trace.rays=5", "trace.directions=random", "order.method=Z", "order.each_depth = true",
                          "order.bin_num=64", "launch.shape=2d"}) {
    CAPTURE(set);
    CHECK_THROWS_WITH_AS(experiment_config(still, "", {set}), doctest::Contains("gives"), ConfigError);
  }
  CHECK(experiment_config(still, "", {"trace.max_depth=3"}).trace.max_depth == 3);
  CHECK(experiment_config(still, "", {"trace.batch_rays=4096"}).trace.batch_rays == 4096);
}

TEST_CASE("figure-6.18 drives through traffic, and averages over the frames after the first") {
  const Experiment& experiment = find_experiment("figure-6.18");
  const Config point = point_config(*experiment.as<OrderFigure>(), experiment_config(experiment, "", {}), 20);
  CHECK(point.transmitters.empty());
  CHECK(std::ranges::count(point.mounts, true, [](const MountConfig& m) { return m.role == "transmitter"; }) == 3);
  CHECK(*point.time.end_s == doctest::Approx(0.2));
  const Experiment& standing = find_experiment("figure-6.1");
  CHECK(point_config(*standing.as<OrderFigure>(), experiment_config(standing, "", {}), 20).transmitters.size() == 1);
}

TEST_CASE("a series launches all rays of its transmitters, every frame, and nothing else") {
  const std::string text =
      "scene.generate = \"--blocks 1\"\ntrace.diffraction = true\ncache.kind = \"concurrent\"\n"
      "links.transmitters = [\"mast\"]\n"
      "[[transmitter]]\nname = \"mast\"\nposition_m = [0, 0, 6]\n"
      "[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -3, 0], [1, 20, -3, 0]]\n"
      "[[mount]]\nname = \"sender\"\nrole = \"transmitter\"\n[[mount]]\nname = \"roof\"\n";
  const Config config = parse_config(text, "a.toml");
  for (const char* name : {"figure-6.1", "figure-6.18"}) {
    const Config point = point_config(*find_experiment(name).as<OrderFigure>(), config, 20);
    CHECK_FALSE(point.trace.reuse);
    CHECK_FALSE(point.trace.diffraction);
    CHECK(point.cache.kind.word() == "none");
  }
  // The transmitters in the frames of a drive are those that the configuration wants.
  const Config moving = point_config(*find_experiment("figure-6.18").as<OrderFigure>(), config, 20);
  CHECK(moving.mounts.size() == 2);
  CHECK(moving.transmitters.size() == 1);
  CHECK(moving.links.transmitters == std::vector<std::string>{"mast"});
}

TEST_CASE("a experiment says by name what a configuration lacks for it") {
  const std::string mounted = "scene.generate = \"--blocks 1\"\n[[mount]]\nname = \"roof\"\n";
  const Config vehicles = parse_config(mounted + "[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -3, 0]]\n", "a.toml");
  const Config live = parse_config(mounted + "[[live_vehicle]]\ntype = \"passenger\"\n", "a.toml");
  for (const Experiment& experiment : wavetracer::study::experiments()) {
    CAPTURE(experiment.name);
    CHECK_NOTHROW(check_experiment(experiment, vehicles));
    Config flat = experiment_config(experiment, "", {});
    CHECK_NOTHROW(check_experiment(experiment, flat));
    flat.trace.max_depth = 0;
    CHECK_THROWS_WITH_AS(check_experiment(experiment, flat), doctest::Contains("give 1 or more"), ConfigError);
    CHECK_THROWS_AS(check_experiment(experiment, live), ConfigError);
  }
}

TEST_CASE("times are sums of the stages' medians, a frame") {
  const StageSeconds a = {{"generate_rays", 1}, {"trace", 10}, {"scan", 2},  {"interact", 3}, {"compact", 4},
                          {"order", 5},         {"sort", 6},   {"solve", 9}, {"frame", 50}};
  StageSeconds b = a, c = a;
  b["trace"] = 1000;  // a slow spell
  c["trace"] = 12;
  const OrderTimes one = summarise({a, b, c}, median);
  CHECK(one.trace_s == doctest::Approx(12));
  CHECK(one.order_s == doctest::Approx(11));
  CHECK(one.unpaid_s == doctest::Approx(22));
  CHECK(one.paid_s() == doctest::Approx(33));
  CHECK(one.frame_s == doctest::Approx(50));
  const auto largest = [](std::vector<double> values) { return std::ranges::max(values); };
  CHECK(summarise({a, b, c}, largest).trace_s == 1000);
  CHECK(summarise({a, c}, median).trace_s == doctest::Approx(11));
  CHECK(summarise({{{"trace", 1}}}, median).order_s == 0);  // nothing was sorted
}

TEST_CASE("orders that find something else are an error, other directions are not") {
  const OrderRow plain{.rays = 2000, .series = unordered(), .times = {.unpaid_s = 1}, .paths = 30, .sequences = 1000};
  OrderRow sorted = plain, born = plain;
  sorted.series = ordered("morton");
  born.series = born_ordered();
  born.paths = 31;
  std::vector<OrderRow> rows = {plain, sorted, born};
  CHECK_NOTHROW(compare(rows));
  rows[1].sequences = 999;
  CHECK_THROWS_WITH_AS(compare(rows),
                       doctest::Contains("2,000 rays: WS finds 30 paths in 1000 sequences, Z finds 30 in 999"),
                       RuntimeError);
  rows[1] = sorted;
  rows[1].paths = 29;
  CHECK_THROWS_AS(compare(rows), RuntimeError);
}

TEST_CASE("the table's gains are the ratios of its own columns") {
  for (const char* name : {"figure-6.1", "figure-6.18"}) {
    const Experiment& experiment = find_experiment(name);
    const std::vector<OrderRow> rows = made_rows(experiment, {1000, 2000}, [](const Series& s, uint64_t rays) {
      const double each = s.method == "none" ? 3e-8 : 1.25e-8;
      return std::pair{each * static_cast<double>(rays), s.method == "none" ? 0.0 : 1.1e-5};
    });
    const Columns<OrderRow>& columns_of = order_columns(experiment.moves());
    const std::vector<std::string> names = names_of(columns_of);
    const std::vector<std::string> lines = split(csv_of(columns_of, rows).text(), '\n');
    REQUIRE(lines.size() == 1 + 2 * experiment.as<OrderFigure>()->series.size());
    const std::string columns =
        "rays,method,mnemonic,shape,each_depth,trace_s,order_s,unpaid_s,paid_s,frame_s,paths,sequences,gain_unpaid,"
        "gain_paid,launched,bins";
    CHECK(lines[0] == columns + (experiment.moves() ? ",frames,reduction_unpaid_percent,reduction_paid_percent" : "") +
                          ",unpaid_error_s,paid_error_s");
    std::vector<std::string> base;
    for (size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> cells = split(lines[i], ',');
      const auto cell = [&](const std::vector<std::string>& row, const char* column) {
        return std::strtod(row.at(std::ranges::find(names, column) - names.begin()).c_str(), nullptr);
      };
      if (cells.at(2) == "WS" && cells.at(3) == "1d") base = cells;
      REQUIRE(!base.empty());
      CHECK(cells[0] == base[0]);
      CHECK(cell(cells, "paid_s") == doctest::Approx(cell(cells, "unpaid_s") + cell(cells, "order_s")).epsilon(1e-5));
      for (const std::string which : {"unpaid", "paid"}) {
        const double gain = cell(base, (which + "_s").c_str()) / cell(cells, (which + "_s").c_str());
        CHECK(cell(cells, ("gain_" + which).c_str()) == doctest::Approx(gain).epsilon(1e-5));
      }
      if (experiment.moves()) {
        CHECK(cells.at(16) == "20");
        CHECK(std::strtod(cells.at(17).c_str(), nullptr) ==
              doctest::Approx(100 * (1 - cell(cells, "unpaid_s") / cell(base, "unpaid_s"))).epsilon(1e-4));
      }
    }
  }
}

TEST_CASE(
    "the script draws a line per series in each of four panels, and launch shapes beside their own in four more") {
  const Experiment& experiment = find_experiment("figure-6.1");
  const std::string script =
      order_figure("figure-6.1", "A device's title", experiment.as<OrderFigure>()->series, Csv()).commands;
  for (const Series& series : experiment.as<OrderFigure>()->series) {
    const bool has_shapes = series == unordered() || series == ordered("hilbert3d-histogram");
    const size_t panels = series.bins != thesis_bins ? 0
                          : has_shapes               ? 8
                                                     : 4;  // other bins are rows of the table alone
    CHECK(occurrences(script, " title '" + label(series) + "'") == panels);
  }
  CHECK(occurrences(script, "with linespoints") == 4 * (8 + 6));  // none has more lines than there are colours
  CHECK(occurrences(script, "'A device''s title'") == 1);
  CHECK(occurrences(script, "/") == occurrences(script, " / "));  // no folder in any name
}
