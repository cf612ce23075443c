// SPDX-License-Identifier: Apache-2.0
// [[target_model]] and [[target]] in config files: keys that do not go with a kind, and what targets do not go with.
#include <doctest/doctest.h>

#include <string>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

std::string model(const std::string& keys) { return "[[target_model]]\nname = \"car\"\n" + keys + "\n"; }
std::string at(const std::string& name) {
  return "[[target]]\nname = \"a\"\nmodel = \"" + name + "\"\nposition_m = [1, 2, 3]\n";
}

}  // namespace

TEST_CASE("target models: what a kind needs and what it refuses") {
  const auto error = [](const std::string& keys) { return error_of(scene + ends + model(keys)); };
  CHECK(error("kind = \"vehicle\"") == "no error");
  CHECK(error("kind = \"vehicle-points\"\npoints_m = [[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1]]") == "no error");
  CHECK(error("rcs_dbsm = [3.0]\npoints_m = [[0,0,1],[0,0,2]]") == "no error");
  CHECK(error("lobes = [[0, 0, 40, 90, 40, 15, 20]]\nbistatic_db = [6, 1.65, 5]") == "no error");
  check_contains(error(""), "has kind = \"custom\" and neither rcs_dbsm nor lobes: give one of them");
  check_contains(error("rcs_dbsm = [3]\nlobes = [[0, 0, 40, 90, 40, 15, 20]]"), "both rcs_dbsm and lobes");
  check_contains(error("rcs_dbsm = [3, 4]"), "has 2 numbers in rcs_dbsm for 1 points");
  check_contains(error("lobes = [[1, 0, 40, 90, 40, 15, 20]]"), "belongs to point 1, but its points are 0 to 0");
  check_contains(error("lobes = [[0, 0, -1, 90, 40, 15, 20]]"), "has a negative width");
  check_contains(error("lobes = [[0, 0, 40, 190, 40, 15, 20]]"), "has the zenith 190");
  check_contains(error("lobes = [[0, 0, 40, 90, 40, 15, -20]]"), "falls by a negative range");
  check_contains(error("lobes = [[0, 0, 40]]"), "seven numbers");
  check_contains(error("kind = \"person\"\nrcs_dbsm = [3]"), "kind = \"person\", which has its own cross section");
  check_contains(error("kind = \"person\"\nlobes = [[0, 0, 40, 90, 40, 15, 20]]"), "which has its own lobes");
  check_contains(error("kind = \"agv\"\nbistatic_db = [1, 1, 1]"), "which has its own bistatic law");
  check_contains(error("kind = \"agv-points\"\npoints_m = [[0, 0, 1]]"), "which has 5 points, but points_m has 1");
  check_contains(error("kind = \"car\""), "vehicle-points");
  check_contains(error_of(scene + ends + model("kind = \"agv\"") + model("kind = \"agv\"")), "is used twice");
}

TEST_CASE("targets: models that there are not, and what targets do not go with") {
  const std::string car = model("kind = \"vehicle\"");
  CHECK(error_of(scene + ends + car + at("car")) == "no error");
  check_contains(error_of(scene + ends + car + at("cat")), "there is no [[target_model]] of this name");
  const auto error = [&](const std::string& keys) { return error_of(scene + keys + ends + car + at("car")); };
  check_contains(error("trace.reception = \"sphere\"\n"), "receives reflected rays only, but there are targets");
  check_contains(error("trace.discovery = \"beams\"\ntrace.floor_db = -120\n"),
                 "trace.floor_db = -120 says nothing of the power of waves that a target scatters");
  check_contains(error("trace.target_diffraction = true\ntrace.target_reflections = 1\n"),
                 "trace.target_diffraction = true needs trace.diffraction = true");
  const std::string body = "[[target_model]]\nname = \"b\"\nkind = \"body\"\non = \"*\"\n";
  CHECK(error_of(scene +
                 "trace.diffraction = true\ntrace.target_diffraction = true\n"
                 "trace.target_reflections = 1\n" +
                 ends + body) == "no error");
  check_contains(error_of(scene + ends + "[[target_model]]\nname = \"b\"\nkind = \"body\"\n"),
                 "and no on, and no [[target]] has it");
  const std::string edges = "trace.diffraction = true\ntrace.edge_rays = 100\ntrace.target_reflections = 1\n";
  check_contains(error(edges), "trace.edge_rays = 100 does not go with trace.target_reflections = 1");
  for (const std::string keys :
       {"trace.reception = \"sphere\"\n", "trace.discovery = \"beams\"\ntrace.floor_db = -120\n"}) {
    CHECK(error(keys + "trace.target = false\n") == "no error");
    CHECK(error_of(scene + keys + ends + car) == "no error");  // nothing is such a target
  }
}

TEST_CASE("parts of targets: keys of their kinds, axes, and models that there are not") {
  const auto error = [&](const std::string& keys, const std::string& of = "car") {
    return error_of(scene + ends + model("kind = \"vehicle\"") + "[[target_part]]\nmodel = \"" + of +
                    "\"\npivot_m = [1, 0.8, 0.3]\nrcs_dbsm = -15\n" + keys + "\n");
  };
  const std::string limb = "kind = \"limb\"\nlength_m = 0.8\nswing_deg = 30\nstride_m = 1.4\n";
  CHECK(error("radius_m = 0.3") == "no error");
  CHECK(error(limb + "phase_deg = 180\npoints = 3") == "no error");
  check_contains(error(""), "[[target_part]] of \"car\" has kind = \"wheel\" and no radius_m: give it one");
  check_contains(error("kind = \"limb\"\nlength_m = 0.8\nswing_deg = 30"), "has kind = \"limb\" and no stride_m");
  check_contains(error("radius_m = 0.3\nswing_deg = 30"), "which has no swing_deg: remove the key");
  check_contains(error(limb + "radius_m = 0.3"), "has kind = \"limb\", which has no radius_m");
  check_contains(error("radius_m = 0"), "radius_m");
  check_contains(error("radius_m = 0.3\npoints = 0"), "points");
  check_contains(error("radius_m = 0.3\naxis = [0, 0, 1]"), "turns about an axis that is upright or has no length");
  check_contains(error("radius_m = 0.3\naxis = [0, 0, 0]"), "turns about an axis that is upright or has no length");
  check_contains(error("radius_m = 0.3", "cat"), "target_part.model = \"cat\": there is no [[target_model]]");
}

TEST_CASE("bodies as targets: keys that they do not have, pieces, and places without a body; the floor of targets") {
  const auto error = [](const std::string& keys) { return error_of(scene + ends + model(keys)); };
  CHECK(error("kind = \"body\"\non = \"passenger\"\npiece_m = 0.1") == "no error");
  check_contains(error("kind = \"body\"\nrcs_dbsm = [3]"),
                 "has kind = \"body\", whose facets and materials are those of the vehicle: remove rcs_dbsm");
  check_contains(error("kind = \"body\"\nxpr_db = 3"), "remove xpr_db");
  check_contains(error("kind = \"body\"\nsize_m = [3, 2, 1]"), "remove size_m");
  check_contains(error("kind = \"body\"\npoints_m = [[3, 2, 1]]"), "remove points_m");
  check_contains(error("kind = \"body\"\nlobes = [[0, 0, 40, 90, 40, 15, 20]]"), "remove lobes");
  check_contains(error("kind = \"body\"\nbistatic_db = [1, 1, 1]"), "remove bistatic_db");
  check_contains(error("kind = \"body\"\npiece_m = 0"), "piece_m");
  check_contains(error("kind = \"agv\"\npiece_m = 0.1"), "has kind = \"agv\" and piece_m, which only a body has");
  check_contains(error_of(scene + ends + model("kind = \"body\"") + at("car")),
                 "has no vehicle_type, whose body would");
  CHECK(error_of(scene + ends + model("kind = \"body\"") + at("car") + "vehicle_type = \"lorry\"\n") == "no error");
  const std::string bounces = "kind = \"body\"\non = \"passenger\"\nbounces = ";
  CHECK(error(bounces + "3") == "no error");
  check_contains(error(bounces + "4"), "bounces");
  check_contains(error(bounces + "0"), "bounces");
  check_contains(error("kind = \"agv\"\nbounces = 1"), "has kind = \"agv\" and bounces, which only a body has");
  check_contains(error_of(scene + "trace.max_depth = 1\n" + ends + model(bounces + "2")),
                 "has bounces = 2, but paths have at most trace.max_depth = 1 interactions");
  const std::string floor = "trace.target_floor_db = -150\n";
  check_contains(error_of(scene + floor + ends), "trace.target_floor_db = -150 has no effect without a [[target]]");
  CHECK(error_of(scene + floor + ends + model("kind = \"agv\"") + at("car")) == "no error");
}
