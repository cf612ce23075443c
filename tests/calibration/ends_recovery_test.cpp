// SPDX-License-Identifier: Apache-2.0
// A transmitter above a small town that stands higher, aside and turned against the configuration: its place and its
// orientation are found again from levels. Cases that need a device are skipped with a message if there is none.
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include "calibration/recovery.hpp"
#include "check_contains.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string town_text(const std::string& end, const std::string& more = "") {
  return "scene.generate = \"--blocks 2x2\"\n[radio]\nfrequency_hz = 5.9e9\n[trace]\nrays = 20000\nmax_depth = 2\n" +
         more + "[[transmitter]]\nname = \"mast\"\nantenna = \"tr38901\"\n" + end;
}

// Places at two storeys that have a path in the true world, and their levels. rise_m: the places of the true world are
// so much higher.
struct Town {
  std::vector<glm::dvec3> at;
  std::vector<double> levels;
};

Town measured_town(const Folder& folder, const std::string& text, size_t count, double rise_m = 0) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> across(-70, 70);
  std::vector<glm::dvec3> all;
  for (size_t i = 0; i < 10 * count; ++i)
    all.push_back({across(random), across(random), (i % 2 == 0 ? 1.5 : 4.5) + rise_m});
  const std::vector<double> levels = gains(folder, text, all);
  Town out;
  for (size_t i = 0; i < all.size() && out.at.size() < count; ++i)
    if (std::isfinite(levels[i])) {
      out.at.push_back(all[i] - glm::dvec3(0, 0, rise_m));
      out.levels.push_back(levels[i]);
    }
  return out;
}

const std::string configured = "position_m = [0, 0, 12]\norientation_deg = [30, -10, 0]\n";
const std::string moved = "position_m = [0.3, 0, 12.4]\norientation_deg = [33, -10, 0]\n";

double error_of(const calibration::Calibration& result, const std::string& name) {
  for (size_t p = 0; p < result.parameters.size(); ++p)
    if (result.parameters[p].name() == name)
      return result.parameters[p].error(result.fit.theta[p], result.fit.errors[p]);
  FAIL("no parameter " << name);
  return 0;
}

}  // namespace

TEST_CASE("the place and the turn of a transmitter are found again from levels without noise") {
  if (!device_present()) return;
  const Folder folder;
  const Town town = measured_town(folder, town_text(moved), 40);
  REQUIRE(town.at.size() == 40);
  const std::string config = folder.file("start.toml", town_text(configured));
  const auto found = calibrated(config, folder.file("m.csv", table(town.at, town.levels)), "none",
                                {"mast.height", "mast.x", "mast.y", "mast.yaw"});
  REQUIRE(found.parameters.size() == 4);
  CHECK(found.agreements[0].before.sigma_db > 0.05);
  CHECK(found.frames_solved > 0);
  for (const auto& [name, truth, within] :
       {std::tuple{"mast.height", 12.4, 0.01}, {"mast.x", 0.3, 0.01}, {"mast.y", 0, 0.01}, {"mast.yaw", 33, 0.1}}) {
    CAPTURE(name);
    CHECK(std::abs(fitted(found, name) - truth) < within);
    CHECK(error_of(found, name) < within);
  }
  // The configuration that is written has the place, and gives the measured levels.
  const RadioEnd& mast = std::as_const(found.config.transmitters)[0];
  CHECK(std::abs(mast.position_m[2] - 12.4) < 0.01);
  CHECK(std::abs(mast.orientation_deg[0] - 33) < 0.1);
  const std::vector<double> again = gains_of_fitted(found, town.at);
  REQUIRE(again.size() == town.at.size());
  for (size_t i = 0; i < again.size(); ++i) CHECK(std::abs(again[i] - found.points[i].after.gain_db) < 1e-9);
}

TEST_CASE("a turn alone is found without solving a frame again, and materials with it") {
  if (!device_present()) return;
  const Folder folder;
  const std::string truth = "[[material]]\nname = \"brick\"\npermittivity = 4.4\n";
  const Town town =
      measured_town(folder, town_text("position_m = [0, 0, 12]\norientation_deg = [27, -7, 4]\n", truth), 60);
  const std::string config = folder.file("start.toml", town_text(configured));
  const auto found = calibrated(config, folder.file("m.csv", table(town.at, town.levels)), "none",
                                {"mast.yaw", "mast.pitch", "mast.roll", "brick.permittivity"});
  REQUIRE(found.parameters.size() == 4);
  CHECK(found.frames_solved == 0);
  for (const auto& [name, value, within] : {std::tuple{"mast.yaw", 27.0, 0.1},
                                            {"mast.pitch", -7.0, 0.1},
                                            {"mast.roll", 4.0, 0.1},
                                            {"brick.permittivity", 4.4, 0.01}}) {
    CAPTURE(name);
    CHECK(std::abs(fitted(found, name) - value) < within);
  }
}

TEST_CASE("with noise and over edges, errors of places are as large as the standard errors say") {
  if (!device_present()) return;
  const Folder folder;
  const std::string edges = "diffraction = true\ndiffraction_rays = 200\n";
  Town town =
      measured_town(folder, town_text("position_m = [0.3, 0, 12]\norientation_deg = [33, -10, 0]\n", edges), 100, 0.4);
  REQUIRE(town.at.size() == 100);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.3);
  for (double& level : town.levels) level += noise(random) - 5;
  const std::string config = folder.file("start.toml", town_text(configured, edges));
  const auto found = calibrated(config, folder.file("m.csv", table(town.at, town.levels)), "all",
                                {"mast.x", "mast.y", "mast.yaw", "receivers.height"}, 0);
  REQUIRE(found.parameters.size() == 4);
  CHECK(found.fit.deviations[0] == doctest::Approx(0.3).epsilon(0.3));
  for (const auto& [name, truth, most] :
       {std::tuple{"mast.x", 0.3, 0.3}, {"mast.y", 0, 0.3}, {"mast.yaw", 33, 1.0}, {"receivers.height", 0.4, 0.4}}) {
    CAPTURE(name);
    MESSAGE(std::string(name), " ", fitted(found, name), " +- ", error_of(found, name));
    CHECK(std::abs(fitted(found, name) - truth) < 4 * error_of(found, name));
    CHECK(error_of(found, name) < most);
  }
  MESSAGE(found.fit_s, " s, ", found.frames_solved, " frames");
  REQUIRE(!found.notes.empty());
  check_contains(found.notes.back(), " m to the heights of this file, which fitted.toml cannot have");
}
