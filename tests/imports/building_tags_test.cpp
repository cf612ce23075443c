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
  CHECK(parse_length_m("-2") == -2);
  for (const char* bad :
       {"", "m", "high", "12 km", "1.000,5", "12;15", "1e3", "nan", "inf", "40''", "5'6", "--3", "."}) {
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
