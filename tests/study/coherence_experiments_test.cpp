// SPDX-License-Identifier: Apache-2.0
// Tests coherence-frames and coherence-rays without a device: the drive, the tables, the paragraphs of made-up rows.
// The numbers are chosen so that the paragraphs are known by hand.
#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <set>
#include "contains.hpp"
#include "study/coherence_frames.hpp"
#include "study/coherence_rays.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"
#include "study/squeezed.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

FramePair frame_pair(const std::string& against, uint32_t frame, uint32_t depth, double total, double by_place,
                     double shares) {
  FramePair out{.against = against, .frame = frame, .depth = depth, .found = {}, .by_place = by_place};
  out.found.points.total = total;
  out.found.both = shares;
  out.found.same_surface = shares / 2;
  out.found.same_sequence = shares / 4;
  return out;
}

LagRow lag(const std::string& directions, uint32_t depth, uint32_t lag, double points, double same_surface) {
  return {directions, depth, {.lag = lag, .points = points, .same_surface = same_surface}};
}

// A wall in the plane x = 5, |y| < 10, |z| < 10, in a scene whose origin is (100, 0, 0).
Scene wall() {
  Scene scene;
  scene.origin_m = {100, 0, 0};
  scene.vertices = {{5, -10, -10}, {5, 10, -10}, {5, 10, 10}, {5, -10, 10}};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return scene;
}

}  // namespace

TEST_CASE("a drive through the scene is an error, one that ends before a wall or passes it is not") {
  const auto drive = [](uint32_t frames, double y_m) {  // 0.1 m per frame, the wall is 5 m away
    Drive out{.name = "ego"};
    for (uint32_t frame = 0; frame < frames; ++frame) {
      out.at_s.push_back(7 + 0.01 * frame);
      out.place_m.push_back({100 + 0.1 * frame, y_m, 0.5});
    }
    return out;
  };
  CHECK_THROWS_WITH_AS(check_way(drive(201, 0), wall()),
                       doctest::Contains("transmitter \"ego\": its way of 20.0 m leads through the scene"),
                       ConfigError);
  CHECK_NOTHROW(check_way(drive(41, 0), wall()));  // 4 m
  CHECK_NOTHROW(check_way(drive(201, 11), wall()));
}

TEST_CASE("coherence-frames: means of subsequent frames, the last frame with the first, the claim") {
  const std::vector<FramePair> rows = {
      frame_pair("first", 1, 1, 0.9, 0.5, 0.8),     frame_pair("first", 1, 2, 0.7, 0.1, 0.8),
      frame_pair("previous", 1, 1, 0.9, 0.5, 0.8),  frame_pair("previous", 1, 2, 0.2, 0.1, 0.8),
      frame_pair("first", 2, 1, 0.61, 0.5, 0.4),    frame_pair("first", 2, 2, study::undefined, 0.1, 0.4),
      frame_pair("previous", 2, 1, 0.7, 0.3, 0.72), frame_pair("previous", 2, 2, 0.26, study::undefined, 0.8)};
  const Drive drive{.at_s = {3, 3.01, 3.02}, .place_m = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}}};
  const std::string text =
      squeezed(words_text(frame_words(find_experiment("coherence-frames"), rows, drive, "a made world", "the device")));
  CAPTURE(text);
  CHECK(contains(
      text, "Measured on the device, 49,000 rays of a transmitter that drives 0.2 m through a made world in 3 frames"));
  CHECK(contains(text, "subsequent ones are 0.100 m apart"));
  CHECK(contains(text, "| depth 1 | depth 2 |\n"));
  CHECK(contains(text, "| subsequent frames, points paired by ray and bounce | 0.80 | 0.23 |"));
  CHECK(contains(text, "| last frame with the first, points paired by ray and bounce | 0.61 | undefined |"));
  CHECK(contains(text, "| subsequent frames, points paired by place | 0.40 | 0.10 |"));
  // Means .8 and .23, from .7 to .9 and from .2 to .26; by place .4 and .1, from .3 to .5.
  CHECK(contains(text,
                 "on average: 20 to 30% | undecided | paired by ray and bounce: no at depth 1, undecided at depth 2 "
                 "(0.23 to 0.80); paired by place: no at depth 2, undecided at depth 1 (0.10 to 0.40) |"));
  CHECK(contains(text,
                 "falls below 5% | refuted | paired by ray and bounce: no at depths 1 and 2 (0.20 to 0.70); paired by "
                 "place: no at depths 1 and 2 (0.10 to 0.30) |"));
  CHECK(contains(text,
                 "no further | refuted | paired by ray and bounce: no at depths 1 and 2 (0.26 to 0.90); paired by "
                 "place: no at depth 2, undecided at depth 1 (0.10 to 0.50) |"));
  CHECK(contains(text, "| subsequent frames: rays that hit in both of those that hit in one | 0.76 | 0.80 |"));
  CHECK(contains(text, "| subsequent frames: of these, on the same surface | 0.38 | 0.40 |"));
  CHECK(contains(text, "| subsequent frames: of these, after the same surfaces | 0.19 | 0.20 |"));
  CHECK(contains(text, "| last frame and first: rays that hit in both of those that hit in one | 0.40 | 0.40 |"));
  CHECK(contains(text, "| last frame and first: of these, on the same surface | 0.20 | 0.20 |"));
  CHECK(contains(text, "| last frame and first: of these, after the same surfaces | 0.10 | 0.10 |"));
  CHECK(contains(text, "0.02 s old"));
  const std::string table = csv_of(frame_columns(drive), rows).text();
  CHECK(table.starts_with("against,frame,time_s,moved_m,depth,"));
  CHECK(std::count(table.begin(), table.end(), '\n') == 9);
  CHECK(contains(table, "\nfirst,2,0.02,0.2,2,0,0,0.4,0.2,0.1,nan,nan,nan,nan,nan,0.1,nan\n"));
}

TEST_CASE("coherence-frames: pairing by ray or by place") {
  // Ray i at depth 1 hits (i, i, i); in the second frame ray 0 misses.
  study::FrameHits a = {std::vector<study::Hit>(7)}, b;
  for (uint32_t i = 0; i < 7; ++i) {
    const double x = i % 2 == 0 ? 0 : 1;  // alternates, so that a shift by one ray reverses it
    a[0][i] = {{x, x, x}, 1, 0, 0};
  }
  b = a;
  b[0][0] = study::Hit{};
  b[0][1].point_m = {1.5, 1, 1};
  const auto pairs = compare_pair(a, b, "first", 3);
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].frame == 3);
  CHECK(pairs[0].found.points.component.y == doctest::Approx(1));
  CHECK(pairs[0].found.pairs == 6);
  // By place, 0 1 0 1 0 1 is compared with 1 0 1 0 1 0.
  CHECK(pairs[0].by_place > 0.9);  // a length, which hides that they are opposite
  CHECK(pairs[0].found.points.pooled > 0.9);
}

TEST_CASE("coherence-frames: whole outputs are lists of all points, ray by ray, each in the order of its depths") {
  const auto hit = [](double x) { return study::Hit{{x, 2 * x, -x}, 1, 0, 0}; };
  const study::Hit miss;
  const study::FrameHits a = {{hit(1), hit(2), hit(3)}, {hit(4), miss, hit(5)}},
                         b = {{hit(1), miss, hit(3)}, {hit(4), miss, hit(5)}};
  const auto xs = [](const std::vector<glm::dvec3>& points) {
    std::vector<double> out;
    for (const glm::dvec3& point : points) out.push_back(point.x);
    return out;
  };
  CHECK(xs(whole_output(a)) == std::vector<double>{1, 4, 2, 3, 5});
  CHECK(xs(whole_output(a, {2, 0, 1})) == std::vector<double>{3, 5, 1, 4, 2});
  CHECK(xs(whole_output(b)) == std::vector<double>{1, 4, 3, 5});
  const FramePair whole = compare_pair(a, b, "previous", 1).back();
  CHECK(whole.depth == 0);
  CHECK(whole.found.pairs == 4);  // by ray and bounce: all that hit in both
  CHECK(whole.found.points.total == doctest::Approx(1));
  // By place, 1 4 2 3 is compared with 1 4 3 5: deviations -1.5 1.5 -0.5 0.5 and -2.25 0.75 -0.25 1.75.
  CHECK(whole.by_place == doctest::Approx(5.5 / std::sqrt(5 * 8.75)));
}

TEST_CASE("coherence-frames: one ray that misses shifts whole outputs, which hurts most where rays are in no order") {
  study::FrameHits a(1);
  for (uint32_t i = 0; i < 1000; ++i) a[0].push_back({{0.1 * i, -0.2 * i, 0.3 * i}, 1, 0, 0});  // along a curve
  study::FrameHits b = a;
  const std::vector<uint32_t> order = random_order(1000);
  CHECK(order == random_order(1000));
  CHECK(std::set<uint32_t>(order.begin(), order.end()).size() == 1000);
  CHECK(compare_pair(a, b, "previous", 1).back().by_place_unordered == doctest::Approx(1));
  b[0][order[0]] = study::Hit{};
  const FramePair whole = compare_pair(a, b, "previous", 1).back();
  CHECK(whole.by_place > 0.99);
  CHECK(whole.by_place_unordered < 0.1);
  CHECK(std::isnan(compare_pair(a, b, "previous", 1).front().by_place_unordered));
}

TEST_CASE("coherence-frames: the table shows the mean and the range of whole outputs") {
  const std::vector<FramePair> rows = {
      frame_pair("previous", 1, 1, 0.9, 0.5, 0.8),  frame_pair("previous", 1, 0, 0.8, 0.1, 0.8),
      frame_pair("previous", 2, 1, 0.7, 0.3, 0.72), frame_pair("previous", 2, 0, 0.9, 0.2, 0.8),
      frame_pair("first", 2, 1, 0.61, 0.5, 0.4),    frame_pair("first", 2, 0, 0.5, 0.6, 0.4)};
  const Drive drive{.at_s = {3, 3.01, 3.02}, .place_m = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}}};
  const std::string text =
      squeezed(words_text(frame_words(find_experiment("figure-6.13"), rows, drive, "a made world", "the device")));
  CAPTURE(text);
  CHECK(contains(text, "| subsequent frames, whole outputs, points paired by place | 0.15 (0.10 to 0.20) |"));
  CHECK(contains(text, "| subsequent frames, whole outputs, points paired by ray and bounce | 0.85 (0.80 to 0.90) |"));
  CHECK(contains(text, "| subsequent frames, points paired by place | 0.40 |"));
}

TEST_CASE("coherence-rays: neighbours, half the correlation, the claim in shares") {
  const std::vector<LagRow> rows = {lag("hilbert", 1, 1, 0.9, 0.95),   lag("hilbert", 1, 2, 0.4, 0.9),
                                    lag("hilbert", 2, 1, 0.8, 0.7),    lag("hilbert", 2, 2, 0.6, 0.6),
                                    lag("fibonacci", 1, 1, -0.4, 0.5), lag("fibonacci", 1, 2, 0.93, 0.8),
                                    lag("fibonacci", 2, 1, -0.3, 0.1), lag("fibonacci", 2, 2, 0.95, 0.1),
                                    lag("random", 1, 1, -0.001, 0.3),  lag("random", 2, 1, 0.02, 0.2)};
  const std::string text = squeezed(words_text(lag_words(find_experiment("coherence-rays"), rows, "the device")));
  CAPTURE(text);
  CHECK(contains(text,
                 "| hit points correlate, hilbert | 0.90 | 0.80 |\n"
                 "| hit points correlate, fibonacci | -0.40 | -0.30 |\n"
                 "| hit points correlate, random | 0.00 | 0.02 |"));
  CHECK(contains(text, "| lag at which that falls below a half, hilbert | 2 | none measured |"));
  CHECK(contains(text, "first hits correlate most, by 0.93 at lag 2"));
  CHECK(contains(text, "surface, hilbert | 0.95 | 0.70 |"));
  CHECK(contains(text, "surface, fibonacci | 0.50 | 0.10 |"));
  CHECK(contains(text, "surface, random | 0.30 | 0.20 |"));
  CHECK(contains(text, "| the wrong surface, hilbert | 0.05 | 0.30 |"));
  CHECK(contains(csv_of(lag_columns(), rows).text(), "\nhilbert,1,2,0,0.4,nan,0.9,nan\n"));
}

TEST_CASE("depth plots: a line per depth and panel, columns by number") {
  DepthPlot plot{.name = "a",
                 .title = "A device's",
                 .max_depth = 3,
                 .x_label = "lag",
                 .panels = {{"one", "lag", "value", "kind", "k"}}};
  const Csv table({"kind", "depth", "lag", "value"});
  const std::string script = depth_figure(plot, table).commands;
  CHECK(contains(script, "using 3:(strcol(1) eq 'k' && column(2) == 3 ? column(4) : NaN)"));
  CHECK(contains(script, "'A device''s'"));
  CHECK_FALSE(contains(script, "== 4"));
  plot.panels[0].y = "values";
  CHECK_THROWS_AS(depth_figure(plot, table), std::logic_error);
}
