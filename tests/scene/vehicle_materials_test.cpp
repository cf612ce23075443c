// SPDX-License-Identifier: Apache-2.0
// Tests materials of vehicles and people: skin against the Cole-Cole model that it was fitted to, names, ranges, and
// the order in which libraries are searched.
#include "scene/material_laws.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Approx;
using doctest::Contains;

namespace {

constexpr double epsilon_0 = 8.8541878128e-12;

// Dry skin of S. Gabriel et al. (1996), table 1: relative permittivity, negative imaginary part.
std::complex<double> cole_cole(double hz) {
  const std::complex<double> j(0, 1);
  const double w = 2 * std::numbers::pi * hz;
  return 4.0 + 32.0 / (1.0 + j * w * 7.234e-12) + 1100.0 / (1.0 + std::pow(j * w * 32.481e-9, 0.8)) +
         0.0002 / (j * w * epsilon_0);
}

std::complex<double> permittivity(const Material& law, double ghz) {
  return {law.a * std::pow(ghz, law.b), -law.c * std::pow(ghz, law.d) / (2 * std::numbers::pi * ghz * 1e9 * epsilon_0)};
}

double reflected_db(const std::complex<double>& permittivity) {
  const std::complex<double> n = std::sqrt(permittivity);
  return 20 * std::log10(std::abs((n - 1.0) / (n + 1.0)));
}

ResolvedMaterials resolve(const std::string& name, double hz, const std::vector<MaterialConfig>& own = {}) {
  RawScene raw;
  raw.file = "car.glb";
  raw.materials.push_back({name, "car.glb", {}, {}, {}, {}});
  raw.meshes.push_back({"body", "car.glb", {}, {}, 0});
  return resolve_materials(raw, SceneConfig{}, own, hz);
}

}  // namespace

TEST_CASE("the model of skin is that of the published values, and ours reflects as it does") {
  // C. Gabriel's tables: 35.11 and 3.717 S/m at 5.8 GHz.
  CHECK(cole_cole(5.8e9).real() == Approx(35.114).epsilon(1e-4));
  CHECK(-cole_cole(5.8e9).imag() * 2 * std::numbers::pi * 5.8e9 * epsilon_0 == Approx(3.717).epsilon(1e-4));
  for (double ghz = 1; ghz <= 100; ghz *= 1.05) {
    CAPTURE(ghz);
    const auto law = find_vehicle_law("human_skin", ghz);
    REQUIRE(law);
    CHECK(law->in_range);
    CHECK(std::isinf(law->material.thickness_m));
    CHECK(std::abs(reflected_db(permittivity(law->material, ghz)) - reflected_db(cole_cole(ghz * 1e9))) < 0.13);
  }
  CHECK_FALSE(find_vehicle_law("human_skin", 0.9)->in_range);
  CHECK_FALSE(find_vehicle_law("skin", 5.9));
}

TEST_CASE("meshes name them as they name those of ITU, and a configuration may change them") {
  CHECK(resolve("vehicle_glass", 5.9e9).materials.at(0).thickness_m == 0.005);
  CHECK(resolve("mat-plastic", 5.9e9).materials.at(0).a == 2.26);
  CHECK(resolve("plastic", 5.9e9, {{.name = "plastic", .thickness_m = 0.004}}).materials.at(0).thickness_m == 0.004);
  const Material bumper = resolve("Bumper", 5.9e9, {{.name = "Bumper", .library = "plastic"}}).materials.at(0);
  CHECK(bumper.name == "Bumper");
  CHECK(bumper.a == 2.26);
  CHECK(resolve("human_skin", 28e9).materials.at(0).a == 145.4);
  CHECK_THROWS_WITH_AS(resolve("rubber", 5.9e9), Contains("vehicle_glass, plastic, human_skin"), InputError);
}

TEST_CASE("what no mesh of the scene has is not told where a vehicle has it") {
  const std::vector<MaterialConfig> own{{.name = "paint", .library = "metal"}, {.name = "wool", .permittivity = 1.2}};
  std::vector<std::string> warnings = resolve("metal", 5.9e9, own).warnings;
  CHECK(warnings.size() == 2);
  Scene car;
  car.report.warnings = resolve("paint", 5.9e9, own).warnings;
  drop_used(warnings, {car});
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] == "[[material]] 'wool': no mesh has this material");
}
