// SPDX-License-Identifier: Apache-2.0
// Tables of measured values as people write them, and mistakes in them.
#include "calibration/measured.hpp"

#include <doctest/doctest.h>

#include "calibration/measured_text.hpp"
#include "check_contains.hpp"

using namespace wavetracer;
using namespace wavetracer::calibration;
using test::check_contains;
using test::mistake;
using test::read_text;

TEST_CASE("columns are found by their names, in any order and case") {
  const MeasuredFile gains = read_text("group,z_m,Y_M,X_m,path_gain_db,tx,delay_spread_ns\nlos,3,2,1,-80.5,a,12\n");
  REQUIRE(gains.points.size() == 1);
  const MeasuredPoint& point = gains.points[0];
  CHECK(point.position == std::array<double, 3>{1, 2, 3});
  CHECK(point.level_db == -80.5);
  CHECK(point.group == "los");
  CHECK(point.tx == "a");
  CHECK(point.line == 2);
  CHECK(point.delay_spread_ns == 12);
  CHECK_FALSE(point.below);
  CHECK(gains.has_z);
  CHECK_FALSE(gains.degrees);
  CHECK(gains.unused.empty());

  const MeasuredFile losses = read_text("X,Y,Z,PathLoss,who\n1,2,3,80.5,me\n4,5,6,90,you\n");
  CHECK(losses.level == Level::path_loss_db);
  CHECK(losses.points[1].level_db == -90);
  CHECK(losses.unused == std::vector<std::string>{"who"});

  const MeasuredFile degrees = read_text("lat,lon,power_dbm\n48.1,11.5,-70\n");
  CHECK(degrees.degrees);
  CHECK_FALSE(degrees.has_z);
  CHECK(degrees.points[0].position == std::array<double, 3>{48.1, 11.5, 0});

  const MeasuredFile both = read_text("lat,lon,x,y,power_dbm\n48.1,11.5,1,2,-70\n");
  CHECK_FALSE(both.degrees);
  CHECK(both.unused == std::vector<std::string>{"lat", "lon"});
}

TEST_CASE("levels below the noise are marked, rows without a level are counted") {
  const MeasuredFile gains = read_text("x,y,path_gain_db\n1,2,<-110\n1,3,< -111.5\n1,4,\n1,5,nan\n,6,-80\n1,7,-80\n");
  REQUIRE(gains.points.size() == 3);
  CHECK(gains.left_out == 3);
  CHECK(gains.points[0].below);
  CHECK(gains.points[1].level_db == -111.5);
  CHECK_FALSE(gains.points[2].below);
  const MeasuredFile losses = read_text("x,y,path_loss_db\n1,2,>110\n");
  CHECK(losses.points[0].below);
  CHECK(losses.points[0].level_db == -110);
}

TEST_CASE("--level chooses among several columns") {
  const std::string text = "x,y,rsrp,path_gain_db\n1,2,-90,-80\n";
  CHECK(read_text(text).points[0].level_db == -80);
  const MeasuredFile rsrp = read_text(text, {.level = "RSRP"});
  CHECK(rsrp.points[0].level_db == -90);
  CHECK(rsrp.level == Level::power_dbm);
  check_contains(mistake(text, {.level = "snr"}), "m.csv:1: there is no column 'snr', which --level asks for");
}

TEST_CASE("mistakes name file, line and column") {
  check_contains(mistake(""), "the file is empty; the header must name the columns x_m and y_m");
  check_contains(mistake("a,b\n1,2\n"), "m.csv:1: no column has a level");
  check_contains(mistake("path_gain_db\n1\n"), "m.csv:1: no columns have positions");
  check_contains(mistake("x,x_m,y,path_gain_db\n1,1,1,1\n"), "the columns 'x' and 'x_m' mean the same");
  check_contains(mistake("x,y,path_gain_db,power_dbm\n1,1,1,1\n"), "'path_gain_db' and 'power_dbm' mean the same");
  check_contains(mistake("x,y,path_gain_db\n1,2,-80\n1,two,-80\n"), "m.csv:3: y = 'two' is not a finite number");
  check_contains(mistake("x,y,path_gain_db\n1,2,>-80\n"),
                 "m.csv:2: '>-80': a level below the noise is written as '<-110'");
  check_contains(mistake("x,y,path_gain_db\n1,2,-80,9\n"),
                 "m.csv:2: the row has 4 cells, but the header names 3 columns");
  check_contains(mistake("lat,lon,path_gain_db\n148,11,-80\n"), "is no place on the earth");
  check_contains(mistake("x,y,path_gain_db,delay_spread_ns\n1,2,-80,-3\n"), "delay_spread_ns = -3 is less than 0");
  check_contains(mistake("x,y,path_gain_db\n1,2,\n"), "no row below the header has a position and a level");
}

TEST_CASE("rows may turn their antenna and name their receiver") {
  const MeasuredFile file =
      read_text("x,y,path_gain_db,yaw_deg,roll_deg,rx,azimuth_spread_deg\n1,2,-80,30,,horn,25\n1,2,-80,,-5,omni,0\n");
  REQUIRE(file.points.size() == 2);
  CHECK(file.points[0].yaw_deg == 30);
  CHECK_FALSE(file.points[0].pitch_deg);
  CHECK_FALSE(file.points[0].roll_deg);
  CHECK(file.points[0].rx == "horn");
  CHECK(file.points[0].azimuth_spread_deg == 25);
  CHECK_FALSE(file.points[1].yaw_deg);
  CHECK(file.points[1].roll_deg == -5);
  CHECK_FALSE(file.points[1].azimuth_spread_deg);  // 0 has no logarithm
  check_contains(mistake("x,y,path_gain_db,yaw_deg\n1,2,-80,north\n"), "m.csv:2: yaw_deg = 'north' is not a finite");
  check_contains(mistake("x,y,path_gain_db,azimuth_spread_deg\n1,2,-80,-1\n"),
                 "azimuth_spread_deg = -1 is less than 0");
}
