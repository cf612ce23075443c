// SPDX-License-Identifier: Apache-2.0
// The permittivity of a slab is found again where levels oscillate with it: from the prior's middle the nearest minimum
// of the misfit is a wrong one. Cases that need a device are skipped with a message if there is none.
#include <algorithm>
#include <cmath>

#include "calibration/measured_world.hpp"
#include "calibration/prior_samples.hpp"
#include "calibration/recovery.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A wall of brick, whose permittivity is 3.91 in the library.
SceneFile wall() { return SceneFile({Part{{Quad{{-60, 10, -20}, {120, 0, 0}, {0, 0, 40}}}, "brick"}}); }

std::string wall_text(const SceneFile& scene, double thickness_m, const std::string& permittivity) {
  return fmt::format(
      "scene.file = \"{}\"\n[radio]\nfrequency_hz = 5.9e9\n[trace]\nrays = 20000\nmax_depth = 1\ndiffraction = false\n"
      "[[material]]\nname = \"material-0\"\nthickness_m = {}\n{}"
      "[[transmitter]]\nname = \"a\"\nposition_m = [-20, 3, 6]\n",
      scene.path().string(), thickness_m, permittivity);
}

}  // namespace

TEST_CASE("the number of samples follows the oscillations of a slab") {
  constexpr double thick_m = 0.2, wavelength_m = 299792458.0 / 5.9e9;
  calibration::NamedRecords world{{"a", "b", "c"}, std::vector<device::wt_material>(3), {}, 5.9e9};
  const auto set = [&](uint32_t record, double imaginary, double thickness_m) {
    device::wt_material& to = world.records[record];
    to.permittivity[0] = 4;
    to.permittivity[1] = imaginary;
    to.thickness_m = thickness_m;
  };
  set(0, -0.01, thick_m);
  set(1, -20, thick_m);
  set(2, 0, INFINITY);
  const auto parameter = [&](uint32_t record, calibration::Property property, double start) {
    return calibration::Parameter{
        .owner = world.names[record], .property = property, .start = start, .prior = 0.5, .records = {record}};
  };
  using calibration::Property;
  const calibration::Parameter permittivity = parameter(0, Property::permittivity, 4);
  const double least = std::sqrt(1 + 3 / std::exp(1.0)), most = std::sqrt(1 + 3 * std::exp(1.0));
  const double expected = 2 * thick_m * (most - least) / wavelength_m;
  CHECK(calibration::oscillations(world, permittivity) == doctest::Approx(expected).epsilon(1e-3));
  const auto samples = [&](const std::vector<calibration::Parameter>& of) {
    return calibration::prior_samples(world, of);
  };
  const auto dense = static_cast<size_t>(std::ceil(20 * expected));
  CHECK(samples({permittivity}).size() == 8 + dense);
  const auto both = samples({permittivity, parameter(0, Property::conductivity, 0.1)});
  CHECK(both.size() == 16 + dense);
  // Near the middle of the prior neighbours are a thirtieth of an oscillation apart, with the conductivity as it is.
  std::vector<double> values;
  for (const std::vector<double>& row : both)
    if (row[1] == 0) values.push_back(row[0]);
  CHECK(values.size() == dense);
  std::ranges::sort(values);
  CHECK(values.front() < -0.9);
  CHECK(values.back() > 0.9);
  double farthest = 0;
  for (size_t i = 1; i < values.size(); ++i)
    if (std::abs(values[i]) < 0.25) farthest = std::max(farthest, values[i] - values[i - 1]);
  CHECK(farthest < 2 * 0.5 / (0.35 * static_cast<double>(dense)));
  CHECK(samples(std::vector(3, permittivity)).size() == 24);
  const calibration::Parameter thickness = parameter(0, Property::thickness, thick_m);
  CHECK(calibration::oscillations(world, thickness) ==
        doctest::Approx(4 * thick_m * (std::exp(1.0) - std::exp(-1.0)) / wavelength_m).epsilon(1e-3));
  // A wave that is lost in the slab, a half space, and a property without a phase have no oscillation.
  for (const auto& still : {parameter(1, Property::permittivity, 4), parameter(2, Property::permittivity, 4),
                            parameter(0, Property::conductivity, 0.1)}) {
    CHECK(calibration::oscillations(world, still) == 0);
    CHECK(samples({still}).size() == 8);
  }
  world.records[0].thickness_m = 30;
  CHECK(samples({permittivity}).size() == 8);  // lost on the way
  world.records[0].permittivity[1] = 0;
  CHECK(samples({permittivity}).size() == 8 + 256);
}

TEST_CASE("the permittivity and the conductivity of a slab are found together") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = wall();
  const std::vector<glm::dvec3> at = places_along_street(40, 7);
  for (const double truth : {2.4, 3.0, 5.5}) {
    const std::vector<double> levels =
        gains(folder, wall_text(scene, 0.2, fmt::format("permittivity = {}\nconductivity_s_m = 0.02\n", truth)), at);
    const auto found =
        calibrated(folder.file("start.toml", wall_text(scene, 0.2, "permittivity = 3.91\nconductivity_s_m = 0.03\n")),
                   folder.file("m.csv", table(at, levels)), "none", {"material-0"}, 0);
    MESSAGE("permittivity ", truth, ": ", fitted(found, "material-0.permittivity"),
            ", conductivity 0.02: ", fitted(found, "material-0.conductivity"), " after ", found.evaluations,
            " evaluations");
    CHECK(fitted(found, "material-0.permittivity") == doctest::Approx(truth).epsilon(0.005));
    CHECK(fitted(found, "material-0.conductivity") == doctest::Approx(0.02).epsilon(0.05));
  }
}

TEST_CASE("the permittivity of a slab is found from that of brick, whatever minima lie between") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = wall();
  const std::vector<glm::dvec3> at = places_along_street(40, 7);
  for (const double thickness_m : {0.2, 0.3})
    for (const double truth : {2.4, 3.0, 5.5, 7.0}) {
      const std::vector<double> levels =
          gains(folder, wall_text(scene, thickness_m, fmt::format("permittivity = {}\n", truth)), at);
      const auto found = calibrated(folder.file("start.toml", wall_text(scene, thickness_m, "permittivity = 3.91\n")),
                                    folder.file("m.csv", table(at, levels)), "none", {"material-0.permittivity"}, 0);
      MESSAGE("a slab of ", thickness_m, " m and permittivity ", truth, ": ", fitted(found, "material-0.permittivity"),
              " after ", found.evaluations, " evaluations and ", found.fit_s, " s");
      CHECK(fitted(found, "material-0.permittivity") == doctest::Approx(truth).epsilon(0.002));
    }
}
