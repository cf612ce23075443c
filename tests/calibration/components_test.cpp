// SPDX-License-Identifier: Apache-2.0
// Components of links: levels and spreads that are computed by hand, and mistakes. Places in coordinates of maps.
#include <doctest/doctest.h>

#include <cmath>

#include "calibration/delay_profile.hpp"
#include "calibration/measured_text.hpp"
#include "calibration/spread_agreement.hpp"
#include "calibration/spreads.hpp"
#include "check_contains.hpp"

using namespace wavetracer;
using namespace wavetracer::calibration;
using test::check_contains;
using test::mistake;
using test::read_text;

TEST_CASE("two equal components: half of their distance in delay, and the spread of their angle") {
  // |e^0 + e^(j 90 deg)| / 2 = 1/sqrt(2), so the spread is sqrt(ln 2) = 47.70 degrees.
  const MeasuredFile file = read_text("x,y,power_db,delay_ns,azimuth_deg\n1,2,-80,100,0\n1,2,-80,140,90\n");
  REQUIRE(file.points.size() == 1);
  CHECK(file.components == 2);
  CHECK(file.points[0].line == 2);
  CHECK(file.points[0].level_db == doctest::Approx(-80 + 10 * std::log10(2.0)).epsilon(1e-12));
  CHECK(*file.points[0].delay_spread_ns == doctest::Approx(20).epsilon(1e-12));
  CHECK(*file.points[0].azimuth_spread_deg == doctest::Approx(std::sqrt(std::log(2.0)) * 180 / M_PI).epsilon(1e-12));
}

TEST_CASE("powers weigh: three components of 1, 2 and 1") {
  // Losses of 90, 90 - 10 lg 2 and 90 dB at 0, 10 and 20 ns: mean 10, variance (100 + 0 + 100) / 4 = 50. Azimuths of
  // -60, 0 and 60 degrees: (0.5 + 2 + 0.5) / 4 = 3/4 along 0.
  const MeasuredFile file = read_text(
      "position,x,y,path_loss_db,delay_ns,azimuth_deg,elevation_deg\np,1,2,90,0,-60,0\n"
      "p,1,2,86.98970004336019,10,0,0\np,1,2,90,20,420,0\n");
  REQUIRE(file.points.size() == 1);
  CHECK(file.points[0].level_db == doctest::Approx(-90 + 10 * std::log10(4.0)).epsilon(1e-12));
  CHECK(*file.points[0].delay_spread_ns == doctest::Approx(std::sqrt(50.0)).epsilon(1e-12));
  CHECK(*file.points[0].azimuth_spread_deg ==
        doctest::Approx(std::sqrt(-2 * std::log(0.75)) * 180 / M_PI).epsilon(1e-12));
  CHECK(file.unused == std::vector<std::string>{"elevation_deg"});
}

TEST_CASE("azimuths have no beginning, and bearings count the other way: both give the same spread") {
  const char* rows = "0,0,-80,350\n0,0,-80,10\n";
  const double across = std::sqrt(-2 * std::log(std::cos(M_PI / 18))) * 180 / M_PI;
  for (const std::string name : {"azimuth_deg", "bearing_deg"}) {
    const MeasuredFile file = read_text("x,y,path_gain_db," + name + "\n" + rows);
    CHECK(*file.points[0].azimuth_spread_deg == doctest::Approx(across).epsilon(1e-9));
    CHECK_FALSE(file.points[0].delay_spread_ns);  // no column of delays
  }
  const MeasuredFile one = read_text("x,y,path_gain_db,azimuth_deg\n0,0,-80,350\n");
  CHECK_FALSE(one.points[0].azimuth_spread_deg);  // one component has no spread
}

TEST_CASE("places, transmitters, receivers and turns are points of their own; the order is that of the file") {
  const MeasuredFile file = read_text(
      "x,y,path_gain_db,delay_ns,tx,rx,yaw_deg\n5,5,-80,1,a,r,0\n1,1,-80,1,a,r,0\n5,5,-80,2,b,r,0\n5,5,-80,3,a,s,0\n"
      "5,5,-80,4,a,r,90\n5,5,-80,9,a,r,0\n");
  REQUIRE(file.points.size() == 5);
  CHECK(file.points[0].line == 2);
  CHECK(*file.points[0].delay_spread_ns == doctest::Approx(4));  // 1 and 9 ns
  CHECK(file.points[1].position == std::array<double, 3>{1, 1, 0});
  CHECK(file.points[4].yaw_deg == 90);
}

TEST_CASE("components without a number are counted; mistakes name the line") {
  CHECK(read_text("x,y,path_gain_db,delay_ns\n1,1,-80,\n1,1,-80,2\n1,1,,2\n").left_out == 2);
  check_contains(mistake("x,y,path_gain_db,delay_ns\n1,1,<-80,2\n"), "m.csv:2: a component needs a power of its own");
  check_contains(mistake("x,y,path_gain_db,delay_ns\n1,1,-99999,2\n"), "path_gain_db = -99999 is no power");
  check_contains(mistake("x,y,path_gain_db,delay_ns,position\n1,1,-80,2,p\n1,2,-80,2,p\n"),
                 "m.csv:3: the place or the group differs from that of line 2, but position = 'p' is the same");
  check_contains(mistake("x,y,path_gain_db,delay_ns,delay_spread_ns\n1,1,-80,2,3\n"),
                 "since there is a column delay_ns, and their spreads are computed; remove the column delay_spread_ns");
  check_contains(mistake("x,y,path_gain_db,azimuth_deg,bearing_deg\n1,1,-80,2,3\n"), "remove one of them");
  check_contains(mistake("x,y,path_gain_db,delay_ns\n1,1,-80,\n"),
                 "and a delay and an azimuth where there are columns");
}

TEST_CASE("x and y of a coordinate system become degrees") {
  // On the central meridian of UTM zone 32 (9 degrees east) x is 500000; the equator has y = 0.
  const MeasuredFile utm = read_text("x,y,z,height_m,path_gain_db\n500000,0,7,2,-80\n", {.crs = "EPSG:32632"});
  CHECK(utm.degrees);
  CHECK(std::abs(utm.points[0].position[0]) < 1e-9);
  CHECK(utm.points[0].position[1] == doctest::Approx(9).epsilon(1e-12));
  CHECK(utm.points[0].position[2] == 2);
  CHECK(utm.unused == std::vector<std::string>{"z"});
  // A metre of latitude at the equator: a(1 - e^2) radians, times the scale of 0.9996.
  const double metre_deg = 180 / M_PI / (6378137 * (1 - 0.00669437999014) * 0.9996);
  for (const char* crs : {"EPSG:32632", "+proj=utm +zone=32 +ellps=WGS84 +units=m"}) {
    const MeasuredFile north = read_text("x,y,height_m,path_gain_db\n500000,100,2,-80\n", {.crs = crs});
    CHECK(north.points[0].position[0] == doctest::Approx(100 * metre_deg).epsilon(1e-6));
  }
  const MeasuredFile swapped = read_text("x,y,height_m,path_gain_db\n5334000,691000,2,-80\n", {.crs = "EPSG:25832"});
  REQUIRE(swapped.notes.size() == 1);
  check_contains(swapped.notes[0], "only with x as north and y as east");
  CHECK(swapped.points[0].position[0] == doctest::Approx(48.1).epsilon(0.01));
  check_contains(mistake("lat,lon,path_gain_db\n48,11,-80\n", {.crs = "EPSG:25832"}),
                 "--crs says in which coordinate system x and y");
  check_contains(mistake("x,y,path_gain_db\n500000,0,-80\n", {.crs = "EPSG:99999"}),
                 "--crs: the coordinate system 'EPSG:99999'");
  check_contains(mistake("x,y,path_gain_db\n500000,0,-80\n", {.crs = "+proj=nonsense"}),
                 "PROJ does not know the projection");
  check_contains(mistake("x,y,path_gain_db\n5,5,-80\n", {.crs = "EPSG:25832"}),
                 "is not in the area of its coordinate system");
}

TEST_CASE("nothing that arrives has no spread, and long delays keep their digits") {
  CHECK(std::isnan(Spreads().delay_ns()));
  CHECK(std::isnan(Spreads().azimuth_deg()));
  Spreads late(1e-3);
  for (const double delay_s : {1e-3, 1e-3 + 2e-9}) late.add(1e-12, delay_s, 0);
  CHECK(late.delay_ns() == doctest::Approx(1).epsilon(1e-6));
  CHECK(late.azimuth_deg() == 0);
}

TEST_CASE("spreads agree by medians of pairs that have a path") {
  const SpreadStatistics of = spread_statistics(std::vector<SpreadPair>{{10, 5}, {20, 20}, {40, 80}, {7, NAN}});
  CHECK(of.points == 3);
  CHECK(of.measured == 20);
  CHECK(of.computed == 20);
  CHECK(of.ratio == 1);
  CHECK(spread_statistics({}).points == 0);
}

TEST_CASE("profiles: triangles around bins, of the power of all, from the first component that counts") {
  // 1 at 100 ns, 0.5 one bin and a half later, and 0.001 before both, which is weaker than 25 dB below 1.501.
  const std::vector<DelayPower> components{{115e-9, 0.5}, {100e-9, 1.0}, {60e-9, 0.001}};
  CHECK(bins_of(components, 10e-9, 100) == 3);
  const std::vector<double> profile = delay_profile(components, 10e-9, 3);
  REQUIRE(profile.size() == 3);
  CHECK(profile[0] == doctest::Approx(10 * std::log10(1.001 / 1.501)).epsilon(1e-9));
  CHECK(profile[1] == doctest::Approx(10 * std::log10(0.25 / 1.501)).epsilon(1e-6));
  CHECK(profile[2] == doctest::Approx(10 * std::log10(0.25 / 1.501)).epsilon(1e-6));
  CHECK(delay_profile(components, 10e-9, 5)[4] == least_bin_db);  // nothing arrives so late
  CHECK(delay_profile({}, 10e-9, 3).empty());
  // A component that moves over the middle of a bin changes no level by a step.
  const auto level = [&](double delay_s) {
    return delay_profile(std::vector<DelayPower>{{100e-9, 1.0}, {delay_s, 0.5}}, 10e-9, 5)[1];
  };
  CHECK(std::abs(level(110e-9 - 1e-15) - level(110e-9 + 1e-15)) < 1e-6);
}

TEST_CASE("components are kept where the file has delays") {
  const MeasuredFile with = read_text("x,y,power_db,delay_ns\n1,2,-80,100\n1,2,-90,140\n");
  REQUIRE(with.points[0].components.size() == 2);
  CHECK(with.points[0].components[1].delay_s == doctest::Approx(140e-9));
  CHECK(with.points[0].components[1].power == doctest::Approx(1e-9));
  CHECK(read_text("x,y,power_db,azimuth_deg\n1,2,-80,100\n1,2,-90,140\n").points[0].components.empty());
}
