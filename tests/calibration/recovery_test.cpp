// SPDX-License-Identifier: Apache-2.0
// A floor and two walls whose materials are known: the levels that they give are measured, and the materials are found
// again from others. Cases that need a device are skipped with a message if there is none.
#include <random>

#include "app/program.hpp"
#include "calibration/calibration.hpp"
#include "radio/links.hpp"
#include "simulation/run.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

SceneFile street() {
  return SceneFile(
      {Part{{Quad{{-50, -10, 0}, {100, 0, 0}, {0, 20, 0}}}, "concrete"},
       Part{{Quad{{-50, 10, 0}, {100, 0, 0}, {0, 0, 15}}, Quad{{50, -10, 0}, {-100, 0, 0}, {0, 0, 15}}}, "brick"}});
}

std::string street_text(const SceneFile& scene, const std::string& materials) {
  return fmt::format("scene.file = \"{}\"\n[radio]\nfrequency_hz = 5.9e9\n[trace]\nrays = 100000\nmax_depth = 3\n{}",
                     scene.path().string(), materials) +
         "[[transmitter]]\nname = \"a\"\nposition_m = [-20, 3, 6]\n";
}

std::vector<glm::dvec3> places(size_t count) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> along(-45, 45), across(-9, 9);
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < count; ++i) out.push_back({along(random), across(random), 1.5});
  return out;
}

// The gains of these places, dB, in their order.
std::vector<double> gains(const Folder& folder, const std::string& text, const std::vector<glm::dvec3>& at) {
  std::string all = text;
  for (size_t i = 0; i < at.size(); ++i)
    all += fmt::format("[[receiver]]\nname = \"r{:04}\"\nposition_m = [{}, {}, {}]\n", i, at[i].x, at[i].y, at[i].z);
  Simulation simulation(load_config(folder.file("true.toml", all)));
  const FrameResult frame = simulation.run_frame(0);
  std::vector<double> out;
  for (const LinkFigures& link : link_figures(frame.paths, 0, frame.world.links, 5.9e9))
    out.push_back(link.path_gain_db);
  return out;
}

std::string table(const std::vector<glm::dvec3>& at, const std::vector<double>& levels) {
  std::string out = "x_m,y_m,z_m,path_gain_db\n";
  for (size_t i = 0; i < at.size(); ++i)
    out += fmt::format("{:.17g},{:.17g},{},{:.17g}\n", at[i].x, at[i].y, at[i].z, levels[i]);
  return out;
}

calibration::Calibration calibrated(const std::string& config, const std::string& measured,
                                    calibration::Offsets offsets, std::vector<std::string> patterns = {"*"}) {
  const calibration::Request request{.config = config,
                                     .sets = {},
                                     .measured = {measured},
                                     .level = "",
                                     .device = "",
                                     .patterns = std::move(patterns),
                                     .offsets = offsets};
  return calibration::calibrate(request, {[](const std::string&) {}, [] { return false; }});
}

double fitted(const calibration::Calibration& result, const std::string& name) {
  for (size_t p = 0; p < result.parameters.size(); ++p)
    if (result.parameters[p].name() == name) return result.parameters[p].value(result.fit.theta[p]);
  FAIL("no parameter " << name);
  return 0;
}

const std::string true_materials =
    "[[material]]\nname = \"material-0\"\npermittivity = 6.5\nconductivity_s_m = 0.3\n"
    "[[material]]\nname = \"material-1\"\npermittivity = 3.0\nconductivity_s_m = 0.05\n";

const std::string true_permittivities =
    "[[material]]\nname = \"material-0\"\npermittivity = 6.5\n[[material]]\nname = \"material-1\"\npermittivity = 3.0\n";

}  // namespace

TEST_CASE("materials are found again from levels without noise, with an offset and without one") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = street();
  const std::vector<glm::dvec3> at = places(60);
  std::vector<double> levels = gains(folder, street_text(scene, true_materials), at);
  const std::string config = folder.file("start.toml", street_text(scene, ""));
  for (const double offset : {0.0, -17.5}) {
    for (double& level : levels) level += offset;
    const calibration::Offsets offsets = offset == 0 ? calibration::Offsets("none") : calibration::Offsets("all");
    const auto found = calibrated(config, folder.file("m.csv", table(at, levels)), offsets);
    CHECK(found.fit.converged);
    CHECK(found.files[0].points.size() == 60);
    CHECK(fitted(found, "material-0.permittivity") == doctest::Approx(6.5).epsilon(0.01));
    CHECK(fitted(found, "material-0.conductivity") == doctest::Approx(0.3).epsilon(0.05));
    CHECK(fitted(found, "material-1.permittivity") == doctest::Approx(3.0).epsilon(0.01));
    CHECK(fitted(found, "material-1.conductivity") == doctest::Approx(0.05).epsilon(0.05));
    REQUIRE(found.agreements.size() == 1);
    CHECK(found.agreements[0].before.sigma_db > 0.2);
    CHECK(found.agreements[0].after.sigma_db < 1e-3);
    CHECK(found.agreements[0].held_out.sigma_db < 1e-2);
    if (offset != 0) CHECK(found.fit.offsets[0] == doctest::Approx(offset).epsilon(1e-3));
    // The configuration that is written gives the measured levels.
    Config again = found.config;
    for (size_t i = 0; i < at.size(); ++i)
      again.receivers.push_back({fmt::format("r{:04}", i), {at[i].x, at[i].y, at[i].z}});
    Simulation simulation(parse_config(resolved_config(again), "fitted.toml"));
    const FrameResult frame = simulation.run_frame(0);
    const auto links = link_figures(frame.paths, 0, frame.world.links, 5.9e9);
    REQUIRE(links.size() == at.size());
    for (size_t i = 0; i < at.size(); ++i) CHECK(std::abs(links[i].path_gain_db + offset - levels[i]) < 1e-3);
  }
}

TEST_CASE("levels with noise: errors are as large as the standard errors say") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = street();
  const std::vector<glm::dvec3> at = places(150);
  std::vector<double> levels = gains(folder, street_text(scene, true_permittivities), at);
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0, 0.5);
  for (double& level : levels) level += noise(random);
  const auto found = calibrated(folder.file("start.toml", street_text(scene, "")),
                                folder.file("m.csv", table(at, levels)), "none", {"*.permittivity"});
  REQUIRE(found.parameters.size() == 2);
  CHECK(found.fit.deviations[0] == doctest::Approx(0.5).epsilon(0.25));
  for (const auto& [name, truth] : {std::pair{"material-0.permittivity", 6.5}, {"material-1.permittivity", 3.0}}) {
    CAPTURE(name);
    const size_t p = found.parameters[0].name() == name ? 0 : 1;
    const double error = found.parameters[p].error(found.fit.theta[p], found.fit.errors[p]);
    CHECK(std::abs(fitted(found, name) - truth) < 4 * error);
    CHECK(error < 0.2 * truth);
    CHECK(found.fit.told[p] > 0.5);
  }
}
