// SPDX-License-Identifier: Apache-2.0
// Tables and sentences about a result that is made by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "calibration/report.hpp"
#include "check_contains.hpp"

using namespace wavetracer;
using namespace wavetracer::calibration;
using test::check_contains;

namespace {

// Two points, three parameters: one that is told, one that is not, and one that has moved far; an offset.
Calibration result() {
  Calibration out;
  MeasuredFile file;
  file.file = "m.csv";
  file.points.resize(2);
  out.points.resize(2);
  for (size_t i = 0; i < 2; ++i) {
    file.points[i].line = 2 + i;
    file.points[i].level_db = out.points[i].measured_db = -80 - 10.0 * static_cast<double>(i);
    out.points[i].point = i;
    out.points[i].tx = "a";
  }
  file.points[0].group = "los";
  out.files = {file};
  out.points[0].before = {-82, 5};
  out.points[0].after = {-79, 6};
  out.points[1].before = out.points[1].after = {-INFINITY, NAN, NAN};
  for (FittedPoint& point : out.points) point.offset_db = -1.5;
  out.parameters = {{"brick", Property::permittivity, 4, 0.5, {0}},
                    {"brick", Property::thickness, 0.1, 0.5, {0}},
                    {"glass", Property::conductivity, 0.02, 1, {1}}};
  out.fit.theta = {0.1, 0.05, -3};
  out.fit.offsets = {-1.5};
  out.fit.errors = {0.02, 0.48, 0.3, 0.2};
  out.fit.told = {0.998, 0.08, 0.91};
  out.fit.correlation.assign(16, 0);
  out.fit.correlation[0 * 4 + 3] = out.fit.correlation[3 * 4 + 0] = -0.95;
  out.offset_names = {"all points"};
  out.notes = {"a note"};
  out.agreements = {{"all", statistics_of(std::vector<LevelPair>{{-80, -82}, {-90, -INFINITY}, {-70, -71}}), {}, {}}};
  return out;
}

}  // namespace

TEST_CASE("findings say what the data do not tell, what they move far, and what is known together only") {
  const std::vector<std::string> found = findings(result());
  REQUIRE(found.size() == 4);
  CHECK(found[0] == "a note");
  check_contains(found[1], "the data hardly tell brick.thickness");
  check_contains(found[2], "the data move glass.conductivity by 3.0 standard deviations of its prior");
  check_contains(found[3], "brick.permittivity and the offset of all points are known together only");
  check_contains(found[3], "is -0.95");
}

TEST_CASE("the table of parameters has values, units and errors") {
  const study::NumberTable table = parameter_table(result());
  REQUIRE(table.rows.size() == 4);
  CHECK(table.rows[0] == std::vector<std::string>{"brick.permittivity", "4", "4.316", "0.06631", "100%"});
  CHECK(table.rows[1][2] == "0.1051 m");
  CHECK(table.rows[2][3] == "0.0002987 S/m");
  CHECK(table.rows[3] == std::vector<std::string>{"offset of all points", "-", "-1.50 dB", "0.20 dB", "-"});
  check_contains(parameters_csv(result()), "glass.conductivity,S/m,0.02,");
}

TEST_CASE("points without a path and without blocks have no numbers in their cells") {
  const std::string text = points_csv(result());
  check_contains(text, "m.csv,2,a,los,0,0,0,0,-80,0,-82,-80.5,nan,nan,5,6,nan,0,0\n");
  check_contains(text, "m.csv,3,a,,0,0,0,0,-90,0,-inf,-inf,nan,nan,nan,nan,nan,nan,nan\n");
  check_contains(calibration_text(result()), "all (3)  as configured  2            1.50    0.71   1.000");
}
