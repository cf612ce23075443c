// SPDX-License-Identifier: Apache-2.0
// [air], [[vegetation]] and materials of vegetation: read, written back, and carriers that the recommendations do not
// know.
#include <limits>

#include "config/texts.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::string air = "[air]\nrain_mm_h = 12.5\nfog_g_m3 = 0.1\ngases = true\ntemperature_c = -3\n";
const std::string tree =
    "[[vegetation]]\nshape = \"cylinder\"\ncentre_m = [1, 2, 3]\nsize_m = [4, 5, 6]\nyaw_deg = 30\n"
    "material = \"hedge\"\n[[material]]\nname = \"hedge\"\nvegetation = \"deciduous\"\nin_leaf = false\n"
    "attenuation_db_m = 0.5\n"
    "max_attenuation_db = inf\n";

}  // namespace

TEST_CASE("air and vegetation: every key is read, and the resolved config reads back the same") {
  const Config first = parse_config(scene + ends + air + tree, "a.toml");
  for (const Config& c : {first, parse_config(first.text, "b.toml")}) {
    CHECK(c.text == first.text);
    CHECK(c.air.rain_mm_h == 12.5);
    CHECK(c.air.fog_g_m3 == 0.1);
    CHECK(c.air.gases);
    CHECK(c.air.temperature_c == -3);
    CHECK(c.air.pressure_hpa == 1013.25);
    CHECK(c.air.humidity_g_m3 == 7.5);
    REQUIRE(c.vegetation.size() == 1);
    CHECK(c.vegetation[0].shape.word() == "cylinder");
    CHECK(c.vegetation[0].centre_m == std::array<double, 3>{1, 2, 3});
    CHECK(c.vegetation[0].size_m == std::array<double, 3>{4, 5, 6});
    CHECK(c.vegetation[0].yaw_deg == 30);
    CHECK(c.vegetation[0].material == "hedge");
    REQUIRE(c.materials.size() == 1);
    CHECK(c.materials[0].vegetation.word() == "deciduous");
    CHECK_FALSE(c.materials[0].in_leaf);
    CHECK(c.materials[0].attenuation_db_m == 0.5);
    CHECK(c.materials[0].max_attenuation_db == std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("air: carriers that a recommendation does not know are refused, each with its key") {
  const auto error = [](const std::string& carriers, const char* key) {
    return error_of(carriers + scene + ends, {std::string("air.") + key});
  };
  check_contains(error("radio.frequency_hz = 0.7e9\n", "gases=true"),
                 "air.gases: ITU-R P.676-13 is known from 1 to 1000 GHz, but a carrier is 0.7 GHz: remove air.gases");
  check_contains(error("radio.frequency_hz = 0.7e9\n", "rain_mm_h=5"), "P.838-3 is known from 1 to 1000 GHz");
  check_contains(error("radio.frequency_hz = 60e9\nradio.frequencies_hz = [60e9, 240e9]\n", "fog_g_m3=0.1"),
                 "P.840-8 is known from 0 to 200 GHz, but a carrier is 240 GHz");
  CHECK(error("radio.frequency_hz = 0.7e9\n", "rain_mm_h=0") == "no error");
  CHECK(error("radio.frequency_hz = 0.7e9\n", "fog_g_m3=0.1") == "no error");
  check_contains(error("", "rain_mm_h=-1"), "from 0 to 250");
}
