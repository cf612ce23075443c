// SPDX-License-Identifier: Apache-2.0
// Tags as people write them, against lengths and rules written down by hand.
#include "imports/building_tags.hpp"

#include <doctest/doctest.h>

using namespace wavetracer;
using namespace wavetracer::imports;

namespace {

struct Answer {
  std::optional<Shape> shape;
  std::map<std::string, uint64_t> guessed, left_out;
};
Answer ask(const Tags& tags, const ImportOptions& options = {}) {
  Answer out;
  out.shape = building_shape(tags, options, out.guessed, out.left_out);
  return out;
}

}  // namespace

TEST_CASE("lengths with units, commas and feet") {
  CHECK(parse_length_m("12") == 12);
  CHECK(parse_length_m(" 12 m ") == 12);
  CHECK(parse_length_m("12m") == 12);
  CHECK(parse_length_m("12,5") == 12.5);
  CHECK(parse_length_m("12,5 m") == 12.5);
  CHECK(*parse_length_m("40 ft") == doctest::Approx(12.192).epsilon(1e-12));
  CHECK(*parse_length_m("40'") == doctest::Approx(12.192).epsilon(1e-12));
  CHECK(*parse_length_m("5'6\"") == doctest::Approx(1.6764).epsilon(1e-12));
  CHECK(*parse_length_m("7'4\"") == doctest::Approx(2.2352).epsilon(1e-12));
  CHECK(*parse_length_m("7 ft 4 in") == doctest::Approx(2.2352).epsilon(1e-12));
  CHECK(*parse_length_m("7\u20324\u2033") == doctest::Approx(2.2352).epsilon(1e-12));
  CHECK(*parse_length_m("12 M") == 12);
  CHECK(*parse_length_m("40 Feet") == doctest::Approx(12.192).epsilon(1e-12));
  CHECK(*parse_length_m("66\"") == doctest::Approx(1.6764).epsilon(1e-12));
  CHECK(*parse_length_m("250 cm") == doctest::Approx(2.5).epsilon(1e-12));
  CHECK(parse_length_m("-2") == -2);
  for (const char* bad : {"", "m", "high", "12 km", "1.000,5", "12;15", "1e3", "nan", "inf", "40''", "5'6", "--3", ".",
                          "~12", "12-15", "12 m high", "5 m 6 in", "3 storeys", "5'6'"}) {
    CAPTURE(bad);
    CHECK_FALSE(parse_length_m(bad).has_value());
  }
}

TEST_CASE("heights: height, then levels, then the default") {
  CHECK(ask({{"height", "17.5 m"}, {"building:levels", "2"}}).shape->top_m == 17.5);
  CHECK(ask({{"building:levels", "4"}}).shape->top_m == 12);
  CHECK(ask({{"building:levels", "4"}, {"roof:levels", "1"}}).shape->top_m == 15);
  CHECK(ask({{"building:levels", "2,5"}}).shape->top_m == 7.5);
  const Answer nothing = ask({{"building", "yes"}});
  CHECK(nothing.shape->top_m == 10);
  CHECK(nothing.guessed.at("neither height nor levels given: default height used") == 1);
  ImportOptions options;
  options.level_height_m = 3.5;
  options.default_height_m = 7;
  CHECK(ask({{"building:levels", "4"}}, options).shape->top_m == 14);
  CHECK(ask({}, options).shape->top_m == 7);
  for (const char* bad : {"tall", "0", "-3", "99999"}) {
    const Answer answer = ask({{"height", bad}, {"building:levels", "3"}});
    CHECK(answer.shape->top_m == 9);
    CHECK(answer.guessed.at("height that cannot be read") == 1);
  }
}

TEST_CASE("roofs on levels, several values, and what cannot be read") {
  const auto top = [](const Tags& tags) { return ask(tags).shape->top_m; };
  CHECK(top({{"building:levels", "2"}, {"roof:height", "5"}}) == 11);
  CHECK(top({{"building:levels", "2"}, {"roof:height", "16 ft"}}) == doctest::Approx(6 + 16 * 0.3048));
  CHECK(top({{"building:levels", "2"}, {"roof:height", "5"}, {"roof:levels", "1"}}) == 11);
  CHECK(top({{"building:levels", "2"}, {"roof:height", "high"}, {"roof:levels", "1"}}) == 9);
  CHECK(top({{"building:levels", "0"}, {"roof:levels", "2"}}) == 6);
  CHECK(top({{"height", "9"}, {"building:levels", "2"}, {"roof:height", "5"}}) == 9);
  CHECK(top({{"building:levels", "2;3"}}) == 9);
  CHECK(top({{"building:levels", "3; 2"}}) == 9);
  CHECK(top({{"height", "12 m;40 ft"}}) == doctest::Approx(12.192));
  CHECK(top({{"est_height", "17"}}) == 17);
  CHECK(top({{"height", "tall"}, {"est_height", "17"}}) == 17);
  CHECK(ask({{"building:levels", "2;3"}}).guessed.at("several values of levels: the largest is used") == 1);
  CHECK(ask({{"height", "tall"}, {"est_height", "17"}}).guessed.at("height that cannot be read") == 1);
  for (const char* bad : {"2;x", "-1", "many", "301", "2+1"}) {
    CAPTURE(bad);
    const Answer answer = ask({{"building:levels", bad}});
    CHECK(answer.shape->top_m == 10);
    CHECK(answer.guessed.at("levels that cannot be read") == 1);
    CHECK(answer.guessed.at("neither height nor levels that can be used: default height used") == 1);
  }
  for (const char* key : {"roof:height", "roof:levels", "min_height", "building:min_level"}) {
    CAPTURE(key);
    const Answer answer = ask({{"building:levels", "3"}, {key, "some"}});
    CHECK(answer.shape->top_m == 9);
    CHECK(answer.shape->bottom_m == 0);
    CHECK(answer.guessed.at(std::string(key) + " that cannot be read") == 1);
  }
}

TEST_CASE("what is below the ground is not built above it") {
  for (const Tags& tags : {Tags{{"building:levels", "2"}, {"layer", "-1"}}, Tags{{"height", "5"}, {"layer", "-2"}},
                           Tags{{"building:levels", "0"}, {"building:levels:underground", "1"}},
                           Tags{{"building:levels", "0"}, {"building:min_level", "-1"}},
                           Tags{{"location", "underground"}, {"height", "4"}}}) {
    const Answer answer = ask(tags);
    CHECK_FALSE(answer.shape);
    CHECK(answer.left_out.size() == 1);
    CHECK(answer.left_out.begin()->first.starts_with("underground"));
  }
  for (const Tags& tags : {Tags{{"building:levels", "2"}, {"layer", "1"}},
                           Tags{{"building:levels", "2"}, {"layer", "-1"}, {"location", "surface"}},
                           Tags{{"building:levels", "2"}, {"building:levels:underground", "3"}},
                           Tags{{"building:levels", "2"}, {"building:min_level", "-1"}}}) {
    const Answer answer = ask(tags);
    REQUIRE(answer.shape);
    CHECK(answer.shape->bottom_m == 0);
    CHECK(answer.shape->top_m == 6);
    CHECK(answer.guessed.empty());
  }
}

TEST_CASE("trees whose tags cannot be read are counted") {
  for (const auto& [key, reason] : {std::pair{"height", "height of a tree or wood that cannot be read"},
                                    std::pair{"diameter_crown", "diameter_crown that cannot be read"}}) {
    const Answer answer = ask({{"vegetation", "tree"}, {key, "large"}});
    CHECK(answer.shape->top_m == 10);
    CHECK(answer.guessed.at(reason) == 1);
  }
  CHECK(ask({{"vegetation", "tree"}, {"height", "300"}, {"diameter_crown", "6"}}).guessed.size() == 2);
  CHECK(ask({{"vegetation", "tree"}, {"height", "20"}, {"diameter_crown", "6 m"}}).guessed.empty());
}

TEST_CASE("parts above the ground, and what is not built") {
  CHECK(ask({{"height", "20"}, {"min_height", "8 m"}}).shape->bottom_m == 8);
  CHECK(ask({{"height", "20"}, {"building:min_level", "2"}}).shape->bottom_m == 6);
  CHECK_FALSE(ask({{"height", "8"}, {"min_height", "8"}}).shape);
  CHECK_FALSE(ask({{"building", "yes"}, {"location", "underground"}}).shape);
  CHECK_FALSE(ask({{"building", "roof"}}).shape);
  CHECK(ask({{"height", "8"}, {"min_height", "8"}}).left_out.size() == 1);
}

TEST_CASE("materials by ITU name, roofs that are not flat are counted") {
  const Answer answer =
      ask({{"height", "9"}, {"building:material", "timber_framing"}, {"roof:material", "roof_tiles"}});
  CHECK(answer.shape->walls == "wood");
  CHECK(answer.shape->roof == "brick");
  CHECK(answer.guessed.empty());
  const Answer strange = ask({{"height", "9"}, {"building:material", "gingerbread"}, {"roof:shape", "gabled"}});
  CHECK(strange.shape->walls == "concrete");
  CHECK(strange.guessed.size() == 2);
}
