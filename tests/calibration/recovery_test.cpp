// SPDX-License-Identifier: Apache-2.0
// A floor and two walls whose materials are known: the levels that they give are measured, and the materials are found
// again from others. Cases that need a device are skipped with a message if there is none.
#include <algorithm>
#include <random>

#include "calibration/fitted_config.hpp"
#include "calibration/measured_world.hpp"
#include "calibration/recovery.hpp"

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
  const std::vector<glm::dvec3> at = places_along_street(60, 4);
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
    const std::vector<double> again = gains_of_fitted(found, at);
    REQUIRE(again.size() == at.size());
    for (size_t i = 0; i < at.size(); ++i) CHECK(std::abs(again[i] + offset - levels[i]) < 1e-3);
  }
}

TEST_CASE("levels with noise: errors are as large as the standard errors say") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = street();
  const std::vector<glm::dvec3> at = places_along_street(150, 4);
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

TEST_CASE("a law over frequency of which one property is fitted becomes constants that can be read") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = street();
  const std::vector<glm::dvec3> at = places_along_street(60, 4);
  const std::vector<double> levels = gains(folder, street_text(scene, true_permittivities), at);
  const std::string law = "[[material]]\nname = \"material-0\"\na = 5.0\nb = 0.02\nc = 0.03\nd = 0.8\n";
  const auto found = calibrated(folder.file("start.toml", street_text(scene, law)),
                                folder.file("m.csv", table(at, levels)), "none", {"material-0.permittivity"});
  REQUIRE(found.parameters.size() == 1);
  CHECK(std::abs(found.fit.theta[0]) > 0.01);
  REQUIRE(found.config.materials.size() == 1);
  const MaterialConfig& material = std::as_const(found.config).materials[0];
  CHECK(material.permittivity == doctest::Approx(fitted(found, "material-0.permittivity")));
  CHECK(material.conductivity_s_m == doctest::Approx(0.03 * std::pow(5.9, 0.8)).epsilon(1e-9));
  const std::vector<double> again = gains_of_fitted(found, at);
  REQUIRE(again.size() == at.size());
  for (size_t i = 0; i < at.size(); ++i) CHECK(std::abs(again[i] - found.points[i].after.gain_db) < 1e-9);
}

TEST_CASE("levels have several minima over the permittivity of a floor, and a fit ends in one that is no worse") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = street();
  const std::vector<glm::dvec3> at = places_along_street(60, 4);
  const std::vector<double> levels = gains(folder, street_text(scene, true_permittivities), at);
  const std::string start = folder.file("start.toml", street_text(scene, true_permittivities)),
                    measured = folder.file("m.csv", table(at, levels));
  calibration::MeasuredWorld world(calibration::config_of_places(start, {}), {calibration::read_measured(measured, {})},
                                   "");
  const auto floor = std::ranges::find(world.materials().names, "material-0");
  REQUIRE(floor != world.materials().names.end());
  std::vector<double> permittivity, misfit_db;
  for (int i = 0; i <= 200; ++i) {
    std::vector<device::wt_material> records = world.materials().records;
    permittivity.push_back(2 + 0.05 * i);
    records[static_cast<size_t>(floor - world.materials().names.begin())].permittivity[0] = permittivity.back();
    const std::vector<calibration::Computed> now = world.weigh({records, world.ends()}, 0);
    double sum = 0;
    for (size_t k = 0; k < at.size(); ++k) sum += std::pow(now[k].gain_db - levels[k], 2);
    misfit_db.push_back(std::sqrt(sum / static_cast<double>(at.size())));
  }
  std::vector<double> minima;
  for (size_t i = 1; i + 1 < misfit_db.size(); ++i)
    if (misfit_db[i] < misfit_db[i - 1] && misfit_db[i] < misfit_db[i + 1]) {
      minima.push_back(permittivity[i]);
      MESSAGE("a minimum at permittivity ", permittivity[i], ": ", misfit_db[i], " dB");
    }
  CHECK(minima.size() > 1);
  const auto least = std::ranges::min_element(misfit_db);
  CHECK(permittivity[static_cast<size_t>(least - misfit_db.begin())] == doctest::Approx(6.5));
  CHECK(*least < 1e-6);
  const auto misfit_near = [&](double value) {
    return misfit_db[static_cast<size_t>(std::lround((value - 2) / 0.05))];
  };
  for (const double from : minima) {
    const std::string away = fmt::format(
        "[[material]]\nname = \"material-0\"\npermittivity = {}\n[[material]]\nname = \"material-1\"\npermittivity = 3.0\n",
        from);
    const auto found =
        calibrated(folder.file("away.toml", street_text(scene, away)), measured, "none", {"material-0.permittivity"});
    const double to = fitted(found, "material-0.permittivity");
    MESSAGE("a fit from ", from, " ends at ", to);
    CHECK(std::ranges::any_of(minima, [&](double value) { return std::abs(value - to) < 0.05; }));
    CHECK(misfit_near(to) <= misfit_near(from));
  }
}
