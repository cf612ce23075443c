// SPDX-License-Identifier: Apache-2.0
// Options of traffic beside those of the city, and vehicles that stay in the streets of the city of the same text.
// Streets are taken from the formula in city.hpp.
#include "scene/city_traffic.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/city.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

TEST_CASE("one text holds the options of a city and of its traffic") {
  const char* const text = "--seed 7 --blocks 3x4 --vehicles=9 --block-m 90 --seconds 2.5 --street-m 16 --step=0.25";
  const TrafficOptions traffic = parse_traffic_options(text);
  CHECK(traffic.seed == 7);
  CHECK(traffic.grid.blocks_x == 3);
  CHECK(traffic.grid.blocks_y == 4);
  CHECK(traffic.grid.block_m == 90);
  CHECK(traffic.grid.street_m == 16);
  CHECK(traffic.vehicles == 9);
  CHECK(traffic.duration_s == 2.5);
  CHECK(traffic.step_s == 0.25);
  CHECK(parse_city_options(text).blocks_y == 4);
  const TrafficOptions defaults = parse_traffic_options("");
  CHECK(defaults.grid.blocks_x == CityOptions{}.blocks_x);
  CHECK(defaults.grid.street_m == CityOptions{}.street_m);
  CHECK(defaults.seed == CityOptions{}.seed);
}

TEST_CASE("options that are not understood") {
  for (const char* bad : {"--vehicle 3", "--vehicles 0", "--vehicles -1", "--vehicles", "--vehicles 2.5", "--seconds 0",
                          "--seconds -1", "--seconds 1s", "--step 0", "--step nan", "--step inf", "--step 0,1"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(parse_traffic_options(bad), Contains("--vehicles N, --seconds S, --step S"), ConfigError);
    CHECK_THROWS_AS(parse_city_options(bad), ConfigError);
  }
}

TEST_CASE("vehicles stay in the streets, all of their corners") {
  for (const char* text : {"--vehicles 50 --seconds 30", "--blocks 3x2 --street-m 12 --block-m 60 --vehicles 30"}) {
    CAPTURE(text);
    const CityOptions city = parse_city_options(text);
    const double pitch_m = city.block_m + city.street_m;
    const Trajectories drive = generate_traffic(text);
    double widest_m = 0;  // from the nearest centre line, of all corners
    for (const Track& track : drive.tracks) {
      const VehicleType& type = drive.types[track.type];
      for (const Sample& s : track.samples) {
        for (const double ahead : {-0.5, 0.5}) {
          for (const double left : {-0.5, 0.5}) {
            const double u = ahead * type.length_m, v = left * type.width_m;
            const double x = s.position_m.x + u * std::cos(s.yaw_rad) - v * std::sin(s.yaw_rad),
                         y = s.position_m.y + u * std::sin(s.yaw_rad) + v * std::cos(s.yaw_rad);
            const double off_x = std::abs(std::remainder(x + city.blocks_x / 2.0 * pitch_m, pitch_m)),
                         off_y = std::abs(std::remainder(y + city.blocks_y / 2.0 * pitch_m, pitch_m));
            widest_m = std::max(widest_m, std::min(off_x, off_y));
          }
        }
      }
    }
    CHECK(widest_m < city.street_m / 2.0);
    CHECK(widest_m > 3);
  }
}
