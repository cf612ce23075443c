// The paragraphs against rows whose gains are known in advance.
// Factors are chosen so that what is reached, and in which order, can be said by hand.
#include "recipes/words.hpp"
#include <doctest/doctest.h>
#include "recipes/rows.hpp"

using namespace wavetracer::recipes;

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A million times the seconds: WS 300 whatever its shape, born ordered 60, the others by the factors given; the
// sort 25.
Cost costs(double h3dh, double z) {
  return [h3dh, z](const Series& s, uint64_t) {
    if (s.directions == "hilbert") return std::pair{60e-6, 0.0};
    if (s.method == "none") return std::pair{s.shape == "3d" ? 240e-6 : 300e-6, 0.0};
    const double factor = s.method == "morton" ? z : s.method == "morton-histogram" ? h3dh * 0.99 : h3dh * 0.9;
    return std::pair{300e-6 / (s.method == "hilbert3d-histogram" && s.shape == "1d" ? h3dh : factor), 25e-6};
  };
}

}  // namespace

TEST_CASE("figure-6.1: claims reached and the expected ranks") {
  const Recipe& recipe = find_recipe("figure-6.1");
  const auto rows = made_rows(recipe, {1000, 49000, 1000000}, costs(3, 2));
  const std::string text = recipe.paragraph(rows, "the device");
  CAPTURE(text);
  // 300 / 100 = 3; 300 / 125 = 2.4
  CHECK(contains(text,
                 "Measured on the device, H3DH is at 1,000 rays 3.00 times as fast as WS (67% less time) with the "
                 "sort not paid and 2.40 times (58% less time) with it paid; at 49,000 rays 3.00 times"));
  CHECK(contains(text, "The claimed 23% at 1,000 rays: reached with the sort not paid, reached with it paid"));
  CHECK(contains(text, "factor of 2.5 at 49,000 rays: reached with the sort not paid, not reached with it paid"));
  CHECK(contains(text,
                 "Speed against WS at 1,000,000 rays, the fastest first, the sort not paid: born ordered 5.00, "
                 "H3DH 3.00, HZ 2.97, "));
  CHECK(contains(text, "H3DH and HZ the fastest of the six there: yes with the sort not paid, yes with it paid"));
  CHECK(contains(text, "WS the slowest: yes with the sort not paid, yes with it paid"));
  CHECK(contains(text, "over the same order in one is a factor of 1.25"));  // WS in three dimensions: 300 / 240
  CHECK(contains(text,
                 "Rays born in order, which need no sort, are at 1,000 rays 5.00 times as fast as WS (80% less "
                 "time); at 49,000 rays 5.00 times"));
}

TEST_CASE("figure-6.1: claims not reached, other ranks, counts not measured") {
  const Recipe& recipe = find_recipe("figure-6.1");
  const auto rows = made_rows(recipe, {1000, 2000}, costs(1.01, 1.2));
  const std::string text = recipe.paragraph(rows, "the device");
  CAPTURE(text);
  // 300 / (300 / 1.01 + 25) = 0.9316
  CHECK(contains(text,
                 "at 1,000 rays 1.01 times as fast as WS (1% less time) with the sort not paid and 0.93 times (7% "
                 "more time) with it paid; at 2,000 rays"));
  CHECK(contains(text, "23% at 1,000 rays: not reached with the sort not paid, not reached with it paid"));
  CHECK(contains(text, "factor of 2.5 at 49,000 rays: not measured"));
  CHECK(contains(text, "H3DH and HZ the fastest of the six there: no with the sort not paid, no with it paid"));
  CHECK(contains(text, "WS the slowest: no with the sort not paid, no with it paid"));  // H3DH2DH: factor 0.909
}

TEST_CASE("figure-6.18: averages over frames") {
  const Recipe& recipe = find_recipe("figure-6.18");
  const std::string text = recipe.paragraph(made_rows(recipe, {49000}, costs(2.5, 1)), "the device");
  CAPTURE(text);
  CHECK(contains(text,
                 "Measured on the device, averaged over 20 frames of a moving transmitter, H3DH is at 49,000 rays "
                 "2.50 times as fast as WS (60% less time) with the sort not paid and 2.07 times (52% less time)"));
  CHECK(contains(text, "factor of 2.5 at 49,000 rays: reached with the sort not paid, not reached with it paid"));
  CHECK(contains(text, "The claimed 23% at 1,000 rays: not measured"));
}

TEST_CASE("a row that is not there is not found") {
  const Recipe& recipe = find_recipe("figure-6.18");
  const auto rows = made_rows(recipe, {1000}, costs(2, 2));
  CHECK(find_row(rows, unordered(), 1000) == &rows[0]);
  CHECK(find_row(rows, unordered(), 2000) == nullptr);
  CHECK(find_row(rows, ordered("morton"), 1000) == nullptr);
}

TEST_CASE("the reason: what the device takes for a few rays already") {
  const Recipe& recipe = find_recipe("figure-6.18");
  const auto with = [&](double few, double many) {
    const auto rows = made_rows(recipe, {1000, 49000}, [&](const Series&, uint64_t rays) {
      return std::pair{rays == 1000 ? few : many, 0.0};
    });
    return recipe.paragraph(rows, "the device");
  };
  CHECK(contains(with(220e-6, 245e-6), "WS takes 90% of its time at 49,000 rays at 1,000 already, which is what"));
  CHECK(contains(with(30e-6, 300e-6), "WS takes 10% of its time at 49,000 rays at 1,000 already, so most"));
  CHECK(reason_words(made_rows(recipe, {1000, 2000}, costs(2, 2))).empty());
}
