// SPDX-License-Identifier: Apache-2.0
// The varied settings, the recommended row, and the table, with rows made by hand and without a device.
#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "accuracy/advice.hpp"
#include "accuracy/axes.hpp"
#include "accuracy/files.hpp"
#include "accuracy/label_places.hpp"
#include "accuracy/latin_hypercube.hpp"
#include "accuracy/table.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::accuracy;

namespace {

Row row(const std::string& axis, const std::string& name, double frame_s, double lost_power, bool reference = false) {
  Row out;
  out.setting = {axis, name, {"trace.rays=" + name}};
  out.frame_s = frame_s;
  out.reference = reference;
  out.paths = 100;
  out.error.lost = lost_power > 0 ? 10 : 0;
  out.error.lost_share = out.error.lost_power = lost_power;
  out.error.power_median_db = out.error.power_max_db = lost_power;
  return out;
}

Row refused(const std::string& axis, const std::string& name, const std::string& why) {
  Row out;
  out.setting = {axis, name, {}};
  out.refusal = why;
  return out;
}

Study made() {
  Study out;
  out.device.name = "a device";
  out.rows = {row("rays", "10000000", 1, 0, true),    row("rays", "10000", 0.01, 0.002),
              row("rays", "100000", 0.02, 5e-4),      row("rays", "1000000", 0.1, 1e-6),
              row("auto", "recall 0.99", 0.03, 2e-4), refused("auto", "recall 0.9", "a reason, with a \"comma\"")};
  return out;
}

bool has(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const auto& text) { return text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("the fastest setting within a loss is recommended, never the reference") {
  Study study = made();
  CHECK(cheapest(study, {"rays", "auto"}, 1e-3)->setting.name == "100000");
  CHECK(cheapest(study, {"rays", "auto"}, 1e-5)->setting.name == "1000000");
  CHECK(cheapest(study, {"auto"}, 1e-3)->setting.name == "recall 0.99");
  CHECK(cheapest(study, {"rays"}, 1e-7) == nullptr);
  CHECK(has(recommendations(study), "10^-3 of the power lost: trace.rays=100000 (20 ms per frame"));
  CHECK(has(recommendations(study), "10^-5 of the power lost: trace.rays=1000000 (100 ms per frame"));
  study.rows[2].error.lost_power = 1e-5;
  CHECK(has(recommendations(study), "Rays, at most 10^-3 and 10^-5 of the power lost: trace.rays=100000 (20 ms"));
  study = made();
  study.rows[0].paths = 0;
  CHECK(
      has(recommendations(study), "Rays: nothing to recommend, because the reference, trace.rays=10000000, finds no"));
  study = made();
  study.rows[3] = row("rays", "1000000", 0.1, 2e-5);
  CHECK(has(recommendations(study), "10^-5 of the power lost: only the reference, trace.rays=10000000 (1 s"));
}

TEST_CASE("beams are cheaper than ten times the rays where there are a few reflections alone") {
  Config reflections;
  reflections.trace.diffraction = reflections.trace.transmission = reflections.trace.scattering = false;
  reflections.trace.max_depth = 6;
  CHECK(beams_are_cheap(reflections));
  for (const auto& change : std::vector<std::function<void(Config&)>>{
           [](Config& config) { config.trace.max_depth = 7; }, [](Config& config) { config.trace.diffraction = true; },
           [](Config& config) { config.trace.transmission = true; },
           [](Config& config) { config.trace.scattering = true; },
           [](Config& config) { config.trace.discover_every_s = 0.1; },
           [](Config& config) { config.output.waypoints = 5; },
           [](Config& config) { config.cache.kind = "concurrent"; }}) {
    Config other = reflections;
    change(other);
    CHECK_FALSE(beams_are_cheap(other));
  }
}

TEST_CASE("one axis at a time: steps of rays with the user's own, depths to one more, mechanisms on and off") {
  Config own;
  own.trace.rays = 200000;
  own.trace.max_depth = 2;
  const std::vector<Axis> still = axes(own, false, default_rays), drive = axes(own, true, {1000, 5000});
  std::vector<std::string> names;
  for (const Setting& setting : still[0].settings) names.push_back(setting.name);
  CHECK(names == std::vector<std::string>{"10,000", "30,000", "100,000", "200,000", "300,000", "1,000,000",
                                          "recall 0.9", "recall 0.99", "recall 0.999"});
  CHECK(still[0].reference.keys == std::vector<std::string>{"trace.rays=10000000"});
  CHECK(drive[0].reference.keys == std::vector<std::string>{"trace.rays=2000000"});  // the largest number is the user's
  CHECK(drive[0].settings.back().keys == std::vector<std::string>{"trace.reuse=false"});
  CHECK(still[1].reference.keys == std::vector<std::string>{"trace.max_depth=3"});
  CHECK(still[1].settings.size() == 3);
  CHECK(still.size() == 2 + mechanisms().size());
  // Beams take the place of the reference of rays, and only there.
  const std::vector<Axis> certified = axes(own, false, default_rays, true);
  CHECK(certified[0].reference.keys == std::vector<std::string>{"trace.discovery=beams"});
  CHECK(certified[0].reference.axis == "rays");
  CHECK(certified[0].settings[0].keys == std::vector<std::string>{"trace.rays=10000", "trace.discovery=rays"});
  CHECK(certified[1].reference.keys == still[1].reference.keys);
  // With diffraction receivers launch rays, too.
  own.trace.diffraction = true;
  own.trace.diffraction_rays = 2000;
  const Axis listeners = axes(own, false, default_rays)[2];
  names.clear();
  for (const Setting& setting : listeners.settings) names.push_back(setting.name);
  CHECK(names == std::vector<std::string>{"300", "1,000", "2,000", "3,000", "10,000", "30,000"});
  CHECK(listeners.reference.keys == std::vector<std::string>{"trace.diffraction_rays=90000"});
  own.trace.rays = 50000;  // a receiver launches no more than a transmitter
  CHECK(axes(own, false, default_rays)[2].reference.keys ==
        std::vector<std::string>{"trace.diffraction_rays=90000", "trace.rays=90000"});
  own.trace.rays.reset();
  CHECK(axes(own, false, default_rays).size() == 2 + mechanisms().size());
  // With rays from edges they launch none, except where settings need them.
  own.trace.edge_rays = 500;
  const std::vector<Axis> edges = axes(own, false, default_rays, true);
  REQUIRE(edges.size() == 3 + mechanisms().size());
  CHECK(edges[0].reference.keys == std::vector<std::string>{"trace.discovery=beams", "trace.edge_rays=0"});
  CHECK(edges[2].reference.keys == std::vector<std::string>{"trace.edge_rays=9000"});
  CHECK(edges[2].settings[1].keys == std::vector<std::string>{"trace.edge_rays=300"});
  CHECK(edges[3].reference.keys == std::vector<std::string>{"trace.diffraction=true"});
  for (const size_t axis : {4, 5})  // a second edge, and transmission
    for (const Setting& setting : {edges[axis].reference, edges[axis].settings[0]})
      CHECK(setting.keys.back() == "trace.edge_rays=0");
  CHECK(edges[6].reference.keys == std::vector<std::string>{"trace.scattering=true"});
  // Every key and value is one that a configuration accepts.
  for (const Axis& axis : drive) {
    std::vector<Setting> all = axis.settings;
    all.push_back(axis.reference);
    for (const Setting& setting : all) {
      CAPTURE(setting.name);
      CHECK_NOTHROW(
          parse_config("scene.generate = \"--blocks 2\"\n[[transmitter]]\nname = \"a\"\nposition_m = [0, 0, 2]\n"
                       "[[receiver]]\nname = \"b\"\nposition_m = [9, 0, 2]\n",
                       "a.toml", setting.keys));
    }
  }
}

TEST_CASE("settings are compared by rays where each scene would choose between beams and rays by itself") {
  Config own;
  own.trace.discovery = "auto";
  const std::vector<Axis> either = axes(own, false, default_rays);
  REQUIRE(either.size() > 2);
  for (const Axis& axis : either) {
    CAPTURE(axis.reference.name);
    CHECK(axis.reference.keys.back() == "trace.discovery=rays");
    for (const Setting& setting : axis.settings) CHECK(setting.keys.back() == "trace.discovery=rays");
  }
  CHECK(axes(own, false, default_rays, true)[0].reference.keys == std::vector<std::string>{"trace.discovery=beams"});
}

TEST_CASE("frames lie in the middles of equal parts of a drive; a short one has all of them") {
  CHECK(spread_frames(11, 5) == std::vector<uint32_t>{1, 3, 5, 7, 9});
  CHECK(spread_frames(1, 5) == std::vector<uint32_t>{0});
  CHECK(spread_frames(3, 5) == std::vector<uint32_t>{0, 1, 2});
  CHECK(spread_frames(1000, 1) == std::vector<uint32_t>{500});
}

TEST_CASE("a row of the table has every column; a refusal says why, quoted, and has no number") {
  const Study study = made();
  const std::string text = encode_csv(study.rows);
  CHECK(
      text.starts_with("axis,setting,reference,own,frame_s,paths,lost_paths,lost_power,gain_median_db,gain_worst_db,"
                       "delay_spread_ns,doppler_spread_hz,links,links_lost,keys,note\n"));
  CHECK(text.find("\nrays,100000,false,false,0.02,100,0.0005,0.0005,0.0005,0.0005,,,0,0,trace.rays=100000,\n") !=
        std::string::npos);
  CHECK(text.find("\nauto,recall 0.9,false,false,,,,,,,,,,,,\"not measured: a reason, with a \"\"comma\"\"\"\n") !=
        std::string::npos);
  CHECK(encode_text(study.rows).find("not measured: a reason") != std::string::npos);
  const std::string page = page_html(study, "wavetracer accuracy -c a<b", "<svg></svg>");
  CHECK(page.find("a&lt;b") != std::string::npos);
  CHECK(page.find("<td>100000</td>") != std::string::npos);
  CHECK(page.find("trace.rays=100000 (20 ms per frame") != std::string::npos);
}

TEST_CASE("times have a unit that fits, counts have commas, and errors of rounding are 0") {
  Row slow = row("rays", "10000000", 1.657, 0);
  slow.paths = 13034;
  slow.error.delay_spread_ns = 4.8e-16;
  slow.error.doppler_spread_hz = 0.031;
  const std::vector<std::string> cells = short_cells(slow);
  CHECK(cells[3] == "1.66 s");
  CHECK(cells[4] == "13,034");
  CHECK(cells[9] == "0");
  CHECK(cells[10] == "0.031");
  slow.frame_s = 0.3828;
  CHECK(short_cells(slow)[3] == "383 ms");
}

TEST_CASE("labels of a figure cover neither points nor each other, and crowded points go without") {
  std::vector<LabelledPoint> points = {{200, 100, "alone"}, {2, 300, "at the left"}, {438, 40, "at the right"}};
  for (int i = 0; i < 30; ++i) points.push_back({300.0 + 2 * (i % 6), 200.0 + 3 * (i / 6), "recall 0.9"});
  const std::vector<LabelSide> sides = label_sides(points, 442, 409);
  CHECK(sides[0] == LabelSide::right);
  CHECK(sides[1] == LabelSide::right);
  CHECK(sides[2] == LabelSide::left);
  CHECK(std::ranges::count(sides, LabelSide::none) > 10);
  CHECK(std::ranges::count(sides, LabelSide::none) < 30);
  const auto overlap = [](const LabelBox& a, const LabelBox& b) {
    return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
  };
  size_t covered = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (sides[i] == LabelSide::none) continue;
    const LabelBox box = label_box(points[i], sides[i]);
    covered += !(box.left >= 0 && box.right <= 442 && box.bottom >= 0 && box.top <= 409);
    for (size_t k = 0; k < points.size(); ++k) {
      covered += overlap(box, {points[k].x - 2, points[k].y - 2, points[k].x + 2, points[k].y + 2});
      covered += k != i && sides[k] != LabelSide::none && overlap(box, label_box(points[k], sides[k]));
    }
  }
  CHECK(covered == 0);
}

TEST_CASE("the figure has at most eight series: mechanisms share one") {
  Study study = made();
  for (const char* axis : {"reuse", "depth", "diffraction_rays", "edge_rays"})
    study.rows.push_back(row(axis, "1", 0.1, 0.1));
  for (const char* axis : {"diffraction", "double_diffraction", "transmission", "scattering"})
    for (const char* name : {"on", "off"})
      study.rows.push_back(row(axis, name, 0.002 * static_cast<double>(study.rows.size()),
                               0.1 / static_cast<double>(study.rows.size())));
  const std::string commands = front_figure(study).commands;
  std::vector<size_t> series;
  for (size_t at = commands.find("\nplot "); at != commands.npos; at = commands.find("\nplot ", at + 1)) {
    const std::string plot = commands.substr(at, commands.find("\nunset", at) - at);
    series.push_back(0);
    for (size_t one = plot.find("with points"); one != plot.npos; one = plot.find("with points", one + 1))
      ++series.back();
  }
  CHECK(series == std::vector<size_t>{7, 7});
  CHECK(commands.find("strcol(1) eq 'double_diffraction' ||") != commands.npos);
}

TEST_CASE("a mechanism is described by what is missing without it") {
  Study study = made();
  Row on = row("diffraction", "on", 0.5, 0, true), off = row("diffraction", "off", 0.1, 0.25);
  off.own = true;
  off.error.power_median_db = 1.25;
  off.error.power_max_db = 31;
  off.error.links_lost = 3;
  study.rows.insert(study.rows.end(), {on, off, refused("scattering", "on", "no material scatters")});
  study.rows.back().reference = true;
  const auto words = recommendations(study);
  CHECK(has(words,
            "Diffraction (trace.diffraction=true): 10 more paths, 25% of all power; "
            "path gains change by 1.2 dB at the median link, 31 dB at the worst; 3 links have no path without it; "
            "a frame takes 500 ms with it, 100 ms without. Yours is off"));
  CHECK(has(words, "Scattering off rough surfaces: not measured, because no material scatters"));
}

TEST_CASE("a Latin hypercube draws once from every interval of every dimension, and is normal") {
  const size_t samples = 100;
  const auto rows = normal_hypercube(samples, 3, 11);
  REQUIRE(rows.size() == samples);
  for (size_t dimension = 0; dimension < 3; ++dimension) {
    std::vector<int> drawn(samples);
    for (const std::vector<double>& row : rows)
      ++drawn[static_cast<size_t>(0.5 * std::erfc(-row[dimension] / std::sqrt(2.0)) * samples)];
    CHECK(std::ranges::count(drawn, 1) == samples);
  }
  CHECK(rows == normal_hypercube(samples, 3, 11));
  CHECK(rows != normal_hypercube(samples, 3, 12));
  CHECK(normal_quantile(0.95) == doctest::Approx(1.6448536269514722).epsilon(1e-12));
}
